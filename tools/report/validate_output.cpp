#include <report/validate_output.h>
#include <report/validate_page.h>
#include <terminal/version.h>

#include <mc/core/file.h>
#include <mc/stats/multiple_testing.h>

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

json results(const Run& run) {
  const auto& [options, cases, reports] = run;
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
                {"alpha", r.alpha},
                {"fault", name(r.fault())},
                {"mass", r.mass},
                {"mass_error", r.mass_error},
                {"detectable", r.detectable},
                {"detectable_cell", r.detectable_cell},
                {"ns_per_sample", r.ns_per_sample},
                {"seconds", r.seconds},
                {"again", command_again(*cases[i], options, cases.size())},
                {"axes", json::array()},
                {"figures", json::array()},
                {"checks", json::array()},
                {"worst", json::array()}};
    for (const mc::Axis& a : r.axes)
      one["axes"].push_back({{"name", a.name}, {"scale", name(a.scale)}, {"a", a.a}, {"b", a.b}, {"unit", a.unit()}});
    for (const mc::Check& c : r.checks)
      one["checks"].push_back({{"name", c.name},
                               {"verdict", name(c.verdict)},
                               {"p", c.p ? json(*c.p) : json()},
                               {"share", c.share},
                               {"statistic", c.statistic},
                               {"limit", c.limit},
                               {"detail", c.detail}});
    for (const mc::Figure& f : r.figures)
      one["figures"].push_back({{"name", f.name}, {"value", f.value}, {"std_error", f.std_error}, {"where", f.where}});
    for (const mc::WorstCell& w : r.worst)
      one["worst"].push_back({{"lo", w.lo},
                              {"hi", w.hi},
                              {"cell", w.lo == w.hi ? "" : describe_cell(r.axes, w.lo, w.hi)},
                              {"where", w.where},
                              {"observed", w.observed},
                              {"expected", w.expected},
                              {"z", w.z}});
    if (r.evidence)
      for (const auto& [samples, p] : r.evidence->p_after) one["p_after"].push_back({samples, p});
    all["cases"].push_back(std::move(one));
  }
  all["passed"] = passed;
  return all;
}

} // namespace

void write_junit(const std::string& file, const Run& run) {
  const auto& [options, cases, reports] = run;
  std::size_t failures = 0;
  double seconds = 0;
  for (const mc::Report& r : reports) failures += !r.passed(), seconds += r.seconds;
  std::string xml = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                "<testsuite name=\"carlo validate\" tests=\"{}\" failures=\"{}\" time=\"{:.3f}\">\n",
                                cases.size(), failures, seconds);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const mc::Report& r = reports[i];
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\">\n    <properties>\n",
                       escape(cases[i]->name), escape(cases[i]->title()), r.seconds);
    const auto property = [&](const char* key, const auto& value) {
      xml += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", key, escape(fmt::format("{}", value)));
    };
    property("parameters", cases[i]->parameters);
    property("scalar", cases[i]->scalar);
    property("verdict", name(r.verdict()));
    property("p", r.p());
    property("alpha", r.alpha);
    property("samples", r.samples);
    property("mass", r.mass);
    property("mass_error", r.mass_error);
    property("detectable", r.detectable);
    property("detectable_cell", r.detectable_cell);
    property("ns_per_sample", r.ns_per_sample);
    property("fault", name(r.fault()));
    property("again", command_again(*cases[i], options, cases.size()));
    xml += "    </properties>\n";
    if (!r.passed())
      xml += fmt::format("    <failure message=\"{}, {}\">{}</failure>\n", name(r.verdict()),
                         escape(std::string(name(r.fault()))), escape(r.to_string()));
    xml += "  </testcase>\n";
  }
  mc::write_file(file, xml + "</testsuite>\n");
}

std::string command_again(const Case& c, const ValidateOptions& options, std::size_t cases) {
  const double alpha = mc::sidak_level(options.alpha, 1 / static_cast<double>(cases));
  const std::string parameters = c.parameters.empty() ? "" : "(" + c.parameters + ")";
  const std::string what = c.again.empty() ? fmt::format("'{}{}' --scalar {}", c.name, parameters, c.scalar) : c.again;
  return fmt::format("carlo validate {} --seed {}{} --alpha {:.6g}", what, options.seed,
                     options.samples_file.empty() ? fmt::format(" --samples {}", options.samples) : std::string(),
                     alpha);
}

void write_json(const std::string& file, const Run& run) { mc::write_file(file, results(run).dump(1) + "\n"); }

void write_page(const std::string& file, const Run& run) {
  const auto& [options, cases, reports] = run;
  json all = results(run);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const mc::Report& r = reports[i];
    if (!r.evidence) continue;
    json& one = all["cases"][i];
    const std::size_t most = r.passed() ? 1024 : 4096;
    if (!r.evidence->cells.empty()) {
      const PackedTree tree = pack_tree(*r.evidence, static_cast<int>(r.axes.size()), most);
      one["tree"] = {{"axes", tree.axes}, {"numbers", tree.numbers}};
    } else if (!r.evidence->outcomes.empty()) {
      one["outcomes"] = {{"of", r.evidence->outcomes.size()}, {"numbers", pack_outcomes(*r.evidence, most / 2)}};
    }
  }
  mc::write_file(file, page(all.dump()));
}

} // namespace carlo
