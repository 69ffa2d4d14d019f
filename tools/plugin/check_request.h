#pragma once
/// The request to check one sampler of foreign code.

#include <catalogue/catalogue.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// What every such request holds; the task adds how it finds the sampler.
nlohmann::json check_request(const char* task, const std::string& who, const std::string& title,
                             const CaseOptions& options);

/// The options of a request, as the worker reads them.
CaseOptions requested_options(const nlohmann::json& request);

} // namespace carlo
