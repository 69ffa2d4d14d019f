#include "validate_output.h"
#include "version.h"

#include <mc/core/file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace carlo {

using nlohmann::json;

namespace {

std::string escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    default: out += c;
    }
  }
  return out;
}

} // namespace

void write_junit(const std::string& file, const std::vector<const Case*>& cases, const std::vector<mc::Report>& reports) {
  std::size_t failures = 0;
  double seconds = 0;
  for (const mc::Report& r : reports) failures += !r.passed(), seconds += r.seconds;
  std::string xml = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"carlo validate\" tests=\"{}\" failures=\"{}\" time=\"{:.3f}\">\n",
                                cases.size(), failures, seconds);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", escape(cases[i]->name), escape(cases[i]->title()), reports[i].seconds);
    if (reports[i].passed()) xml += "/>\n";
    else
      xml += fmt::format(">\n    <failure message=\"{}\">{}</failure>\n  </testcase>\n", escape(fmt::format("{}, {}", name(reports[i].verdict()), name(reports[i].fault()))),
                         escape(reports[i].to_string()));
  }
  mc::write_file(file, xml + "</testsuite>\n");
}

void write_json(const std::string& file, const ValidateOptions& options, const std::vector<const Case*>& cases, const std::vector<mc::Report>& reports) {
  json all = {{"command", options.command}, {"commit", commit},       {"seed", options.seed},
              {"samples", options.samples}, {"alpha", options.alpha}, {"cases", json::array()}};
  bool passed = true;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const mc::Report& r = reports[i];
    passed = passed && r.passed();
    json one = {{"name", cases[i]->name},
                {"parameters", cases[i]->parameters},
                {"scalar", cases[i]->scalar},
                {"verdict", name(r.verdict())},
                {"p", r.p()},
                {"fault", name(r.fault())},
                {"mass", r.mass},
                {"mass_error", r.mass_error},
                {"detectable", r.detectable},
                {"detectable_cell", r.detectable_cell},
                {"ns_per_sample", r.ns_per_sample},
                {"seconds", r.seconds},
                {"checks", json::array()},
                {"worst", json::array()}};
    for (const mc::Check& c : r.checks)
      one["checks"].push_back({{"name", c.name}, {"verdict", name(c.verdict)}, {"p", c.p ? json(*c.p) : json()}, {"share", c.share},
                               {"statistic", c.statistic}, {"limit", c.limit}, {"detail", c.detail}});
    for (const mc::WorstCell& w : r.worst)
      one["worst"].push_back({{"lo", w.lo}, {"hi", w.hi}, {"observed", w.observed}, {"expected", w.expected}, {"z", w.z}, {"where", w.where}});
    all["cases"].push_back(std::move(one));
  }
  all["passed"] = passed;
  mc::write_file(file, all.dump(1) + "\n");
}

} // namespace carlo
