#include <mc/check/laws.h>

#include <mc/check/subject/quantization.h>
#include <mc/check/table.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <chrono>
#include <optional>

namespace mc {

std::vector<Check> check_deterministic_laws(const AnyDistribution& distribution, const LawOptions& options,
                                            std::vector<UntriedLaw>* untried) {
  Report report;
  run_laws(distribution_laws(), report, distribution, options);
  if (!distribution.states_weight)
    report.untried.push_back({"weight = f / pdf", "a sample states no weight and no pdf"});
  if (untried) untried->insert(untried->end(), report.untried.begin(), report.untried.end());
  return report.checks;
}

AnyDistribution with_tolerances(AnyDistribution distribution, const LawOptions& options) {
  distribution.mass_tolerance = options.mass_eps * distribution.epsilon();
  distribution.invert_tolerance = options.invert_eps * distribution.epsilon();
  return distribution;
}

namespace {

// If rounding to float explains wrong counts, adds this to the first failed test.
void name_float(const AnyDistribution& distribution, std::uint64_t seed, Report& report) {
  for (Check& c : report.checks) {
    if (c.verdict != Verdict::fail || !c.p) continue;
    const std::string cause = describe_quantization(distribution, seed);
    if (!cause.empty()) c.detail += (c.detail.empty() ? "" : "; ") + cause;
    return;
  }
}

} // namespace

Report check_laws(const AnyDistribution& original, const LawOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AnyDistribution distribution = original;
  distribution.open_interval = distribution.open_interval || options.statistics.open_interval;
  Report report;
  if (options.statistics.samples > 0) {
    report = check_subject(make_subject(distribution), options.statistics);
    name_float(distribution, options.statistics.seed, report);
  } else {
    report.subject = distribution.name;
    report.alpha = options.statistics.alpha;
  }
  for (Check& check : check_deterministic_laws(distribution, options, &report.untried))
    report.checks.push_back(std::move(check));
  if (distribution.ns_per_sample) report.ns_per_sample = distribution.ns_per_sample();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

Report check_random_parameters(int count, const std::function<AnyDistribution(Pcg& random)>& make,
                               const LawOptions& options) {
  require(count >= 1, "check_random_parameters: count = {}; at least 1 is needed", count);
  LawOptions each = options;
  each.statistics.alpha = sidak_level(options.statistics.alpha, 1.0 / count);
  Pcg random(options.statistics.seed, 55);
  std::optional<Report> worst;
  for (int i = 0; i < count; ++i) {
    each.statistics.seed = hash(options.statistics.seed, static_cast<std::uint64_t>(i));
    Report report = check_laws(make(random), each);
    if (!report.passed()) return report;
    if (!worst || report.p() < worst->p()) worst = std::move(report);
  }
  return std::move(*worst);
}

} // namespace mc
