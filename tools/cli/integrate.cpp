#include <cli/subcommand.h>
#include <integrands/find.h>
#include <report/report_json.h>
#include <terminal/interrupt.h>
#include <terminal/progress.h>
#include <terminal/version.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/estimate/integrate.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace carlo {

namespace {

struct IntegrateOptions {
  std::string integrand; ///< a name, or an expression
  std::string domain;    ///< "x=0:1,y=-1:2" for an expression
  bool list = false;
  double rel_error = 1e-3, abs_error = 0;
  std::uint64_t max_calls = 10'000'000;
  std::string method = "auto";
  std::uint64_t seed = 1;
  int threads = 0;
  std::string json;
  std::string command;
};

// What a user can do where there is no error bar.
const char* remedy(mc::ErrorBar bar) {
  switch (bar) {
  case mc::ErrorBar::known: return "";
  case mc::ErrorBar::unseen: return "; raise --max-calls, or choose a --domain around it";
  case mc::ErrorBar::infinite_variance: return ". Substitute a variable that removes the singularity";
  }
  return "";
}

std::vector<Option> rows(IntegrateOptions& o) {
  return {
      {"INTEGRAND", "", &o.integrand, "Name (see --list) or expression, e.g. \"exp(-x*x)*cos(y)\""},
      {"-d,--domain", "BOUNDS", &o.domain, "Bounds of an expression's variables, e.g. \"x=0:1,y=-inf:inf\""},
      {"--list", "", &o.list, "List the named integrands, and stop"},
      {"--rel-error", "RATIO", &o.rel_error, "Relative standard error to reach"},
      {"--abs-error", "ERROR", &o.abs_error, "Absolute standard error that also suffices"},
      {"--max-calls", "N", &o.max_calls, "Most evaluations of the integrand"},
      {"--method", "NAME", &o.method, "auto, plain, stratified, rqmc, vegas or tree"},
      {"--seed", "N", &o.seed, "Seed"},
      {"--threads", "N", &o.threads, "Threads, 0 for all of the machine's"},
      {"--json", "FILE", &o.json, "Write the result to this file"},
  };
}

int integrate(const IntegrateOptions& o) {
  if (o.list) {
    for (const Experiment* e : named_integrands()) std::printf("%-26s %s\n", e->name.c_str(), e->title.c_str());
    return exit_ok;
  }
  mc::require(!o.integrand.empty(), "integrate: name an integrand or give an expression; --list shows the names");
  if (!o.json.empty()) mc::require_writable(o.json);
  const Experiment e = find_integrand(o.integrand, o.domain);

  mc::IntegrateOptions settings;
  settings.rel_error = o.rel_error;
  settings.abs_error = o.abs_error;
  settings.max_calls = o.max_calls;
  settings.method = mc::method_from(o.method);
  settings.seed = o.seed;
  settings.threads = o.threads;
  Progress progress;
  settings.progress = [&](const mc::IntegrateProgress& p) {
    progress.show(double(p.calls) / double(o.max_calls),
                  fmt::format("{:.8g} ± {:.2g}", p.estimate.value, p.estimate.std_error));
  };
  const Interrupt interrupt;
  settings.cancel = interrupt.flag();
  const mc::Integral r = mc::integrate_unit(e.f, e.dim, settings);
  progress.clear();

  fmt::print("{} = {}{}\n", e.title, r.to_string(), remedy(r.error_bar));
  std::printf("%s calls in %s by %s; stopped: %s\n", format_count(double(r.calls)).c_str(),
              format_seconds(r.seconds).c_str(), std::string(name(r.method)).c_str(),
              std::string(name(r.stop)).c_str());
  if (std::isfinite(e.truth) && r.error_bar != mc::ErrorBar::known) std::printf("the true value is %.10g\n", e.truth);
  else if (std::isfinite(e.truth))
    std::printf("the true value is %.10g, %.2f standard errors away\n", e.truth,
                r.estimate.std_error > 0 ? std::abs(r.estimate.value - e.truth) / r.estimate.std_error : 0.0);
  if (!o.json.empty()) {
    nlohmann::json j = {{"command", o.command},
                        {"commit", commit},
                        {"seed", o.seed},
                        {"integrand", e.name},
                        {"value", r.estimate.value},
                        {"std_error", r.estimate.std_error},
                        {"lo", r.interval.lo},
                        {"hi", r.interval.hi},
                        {"calls", r.calls},
                        {"seconds", r.seconds},
                        {"method", name(r.method)},
                        {"stop", name(r.stop)},
                        {"error_bar", name(r.error_bar)},
                        {"chi2", r.chi2},
                        {"chi2_dof", r.chi2_dof},
                        {"consistent", r.consistent}};
    if (std::isfinite(e.truth)) j["truth"] = e.truth;
    mc::write_file(o.json, json_text(j));
  }
  return r.stop == mc::Stop::cancelled ? exit_interrupted : exit_ok;
}

} // namespace

Subcommand integrate_subcommand() {
  return make_subcommand<IntegrateOptions>(
      "integrate", "Integrate a named integrand or an expression, with an error bar", rows, integrate);
}

} // namespace carlo
