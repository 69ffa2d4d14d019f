#include "commands.h"
#include "experiments.h"
#include "progress.h"
#include "version.h"

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/estimate/integrate.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace carlo {

int integrate(const IntegrateOptions& o) {
  if (o.list) {
    for (const Experiment& e : experiments()) std::printf("%-24s %s\n", e.name.c_str(), e.title.c_str());
    return exit_ok;
  }
  mc::require(!o.integrand.empty(), "integrate: name an integrand; --list shows them all");
  const Experiment& e = experiment(o.integrand);

  mc::IntegrateOptions settings;
  settings.rel_error = o.rel_error;
  settings.abs_error = o.abs_error;
  settings.max_calls = o.max_calls;
  settings.method = mc::method_from(o.method);
  settings.seed = o.seed;
  settings.threads = o.threads;
  Progress progress;
  settings.progress = [&](const mc::IntegrateProgress& p) {
    progress.show(double(p.calls) / double(o.max_calls), fmt::format("{:.8g} ± {:.2g}", p.estimate.value, p.estimate.std_error));
  };
  const mc::Integral r = mc::integrate_unit(e.f, e.dim, settings);
  progress.clear();

  std::printf("%s = %.10g ± %.2g (standard error), 95 %% in [%.10g, %.10g]\n", e.title.c_str(), r.estimate.value, r.estimate.std_error, r.interval.lo,
              r.interval.hi);
  std::printf("%s calls in %s by %s; stopped: %s; the true value is %.10g, %.2f standard errors away\n", format_count(double(r.calls)).c_str(),
              format_seconds(r.seconds).c_str(), std::string(name(r.method)).c_str(), std::string(name(r.stop)).c_str(), e.truth,
              r.estimate.std_error > 0 ? std::abs(r.estimate.value - e.truth) / r.estimate.std_error : 0.0);
  if (!o.json.empty()) {
    const nlohmann::ordered_json j = {{"command", o.command},   {"commit", commit},          {"seed", o.seed},
                                      {"integrand", e.name},    {"value", r.estimate.value}, {"std_error", r.estimate.std_error},
                                      {"lo", r.interval.lo},    {"hi", r.interval.hi},       {"calls", r.calls},
                                      {"seconds", r.seconds},   {"method", name(r.method)},  {"stop", name(r.stop)},
                                      {"truth", e.truth}};
    mc::write_file(o.json, j.dump(1) + "\n");
  }
  return exit_ok;
}

} // namespace carlo
