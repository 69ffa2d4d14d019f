#include <plugin/check_request.h>

#include <nlohmann/json.hpp>

namespace carlo {

nlohmann::json check_request(const char* task, const std::string& who, const std::string& title,
                             const CaseOptions& options) {
  return {{"task", task},
          {"who", who},
          {"title", title},
          {"samples", options.samples},
          {"seed", options.seed},
          {"alpha", options.alpha},
          {"evidence", options.evidence},
          {"open_interval", options.open_interval}};
}

CaseOptions requested_options(const nlohmann::json& request) {
  CaseOptions options;
  options.samples = request["samples"];
  options.seed = request["seed"];
  options.alpha = request["alpha"];
  options.evidence = request["evidence"];
  options.open_interval = request["open_interval"];
  return options;
}

} // namespace carlo
