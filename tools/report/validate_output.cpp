#include <report/report_json.h>
#include <report/validate_output.h>
#include <report/validate_page.h>
#include <terminal/version.h>

#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace carlo {

using nlohmann::json;

namespace {

json result(const Case& c, const mc::Report& r, const std::string& again) {
  json one = to_json(r);
  one.erase("evidence"); // the page packs the evidence
  one.erase("subject");
  one.update({{"name", c.name},
              {"parameters", c.parameters},
              {"scalar", c.scalar},
              {"verdict", name(r.verdict())},
              {"p", r.p()},
              {"fault", name(r.fault())},
              {"again", again}});
  for (std::size_t i = 0; i < r.axes.size(); ++i) one["axes"][i]["unit"] = r.axes[i].unit();
  for (std::size_t i = 0; i < r.worst.size(); ++i) {
    const mc::WorstCell& w = r.worst[i];
    one["worst"][i]["cell"] = w.lo == w.hi ? "" : describe_cell(r.axes, w.lo, w.hi);
  }
  if (r.evidence)
    for (const auto& [samples, p] : r.evidence->p_after) one["p_after"].push_back({samples, p});
  return one;
}

json results(const ValidationRun& run) {
  const auto& [settings, cases, reports, interrupted, unchecked] = run;
  json all = {{"command", settings.command}, {"commit", commit},        {"seed", settings.seed},
              {"samples", settings.samples}, {"alpha", settings.alpha}, {"cases", json::array()}};
  bool passed = !interrupted && unchecked.empty();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    passed = passed && reports[i].passed();
    all["cases"].push_back(
        result(*cases[i], reports[i], repeat_command(*cases[i], settings, cases.size() + unchecked.size())));
  }
  all["passed"] = passed;
  if (interrupted) all["interrupted"] = true;
  for (const UncheckedCase& u : unchecked)
    all["errors"].push_back({{"name", u.test_case->name},
                             {"parameters", u.test_case->parameters},
                             {"scalar", u.test_case->scalar},
                             {"error", u.error}});
  return all;
}

// Rounds all numbers to `digits` significant digits.
void shorten_numbers(json& j, int digits) {
  if (j.is_number_float()) j = std::stod(fmt::format("{:.{}g}", j.get<double>(), digits));
  if (!j.is_structured()) return;
  for (json& part : j) shorten_numbers(part, digits);
}

// Leaves out what the page does not show: the details of checks that pass, and digits.
void shorten(json& one, const mc::Report& r) {
  one.erase("figures");
  for (json& check : one["checks"]) {
    check.erase("fault");
    check.erase("share");
    if (check["verdict"] == "pass")
      for (const char* key : {"detail", "verdict"}) check.erase(key);
    if (!check["p"].is_null())
      for (const char* key : {"statistic", "limit"}) check.erase(key);
    else check.erase("p");
  }
  for (json& cell : one["worst"])
    for (const char* key : {"lo", "hi"}) cell.erase(key);
  shorten_numbers(one["checks"], 4);
  shorten_numbers(one, 6);
  one["mass"] = r.mass;
}

// Largest number of cells, or of outcomes.
constexpr std::size_t most_cells_of_pass = 512, most_cells_of_failure = 4096;

json page_case(json one, const mc::Report& r) {
  shorten(one, r);
  if (!r.passed()) one["finding"] = r.finding();
  if (!r.is_statistical()) one["p"] = nullptr;
  if (!r.evidence) return one;
  const std::size_t most = r.passed() ? most_cells_of_pass : most_cells_of_failure;
  if (!r.evidence->cells.empty()) one["tree"] = pack_tree(*r.evidence, static_cast<int>(r.axes.size()), most);
  else if (!r.evidence->outcomes.empty())
    one["outcomes"] = {{"of", r.evidence->outcomes.size()}, {"counts", pack_outcomes(*r.evidence, most)}};
  return one;
}

} // namespace

std::string repeat_command(const Case& c, const ValidationSettings& settings, std::size_t cases) {
  const double alpha = mc::sidak_level(settings.alpha, 1 / static_cast<double>(cases));
  const std::string parameters = c.parameters.empty() ? "" : "(" + c.parameters + ")";
  const std::string what =
      c.rerun_arguments.empty() ? fmt::format("'{}{}' --scalar {}", c.name, parameters, c.scalar) : c.rerun_arguments;
  return fmt::format("carlo validate {} --seed {}{} --alpha {:.6g}{}", what, settings.seed,
                     settings.from_file ? std::string() : fmt::format(" --samples {}", settings.samples), alpha,
                     settings.open_interval ? " --open-interval" : "");
}

std::string validation_json(const ValidationRun& run) { return json_text(results(run)); }

std::string validation_page(const ValidationRun& run) {
  json all = results(run);
  for (std::size_t i = 0; i < run.reports.size(); ++i) all["cases"][i] = page_case(all["cases"][i], run.reports[i]);
  return fill_page_template(all.dump(-1, ' ', false, json::error_handler_t::replace));
}

} // namespace carlo
