#include <mc/check/laws.h>

#include <mc/check/subject/quantization.h>

#include <chrono>

namespace mc {

// Each law is one file of laws/ and one row here. A law without checks reports what the distribution lacks.
Law boundary_law, batch_consistency_law, support_law, jacobian_law, precision_law;
struct LawRow {
  Law* law;
  const char *name, *missing;
};
constexpr LawRow laws[] = {
    {boundary_law, "boundary and branches of u", "sample takes no u"},
    {determinism_law, "determinism", "sample takes no u"},
    {batch_consistency_law, "batch consistency", "sample takes one u at a time"},
    {support_law, "pdf > 0 where eval > 0", "no eval"},
    {inverse_law, "invert(sample(u)) = u", "no invert"},
    {jacobian_law, "|det| pdf = 1", "needs invert, and as many u as dimensions"},
    {precision_law, "float and double against 50 digits", "no cast to 50 digits"},
};

std::vector<Check> check_deterministic_laws(const AnyDistribution& distribution, const LawOptions& options,
                                            std::vector<UntriedLaw>* untried) {
  std::vector<Check> checks;
  for (const LawRow& row : laws) {
    std::vector<Check> found = row.law(distribution, options);
    if (found.empty() && untried) untried->push_back({row.name, row.missing});
    for (Check& check : found) checks.push_back(std::move(check));
  }
  if (!distribution.states_weight && untried)
    untried->push_back({"weight = f / pdf", "a sample states no weight and no pdf"});
  return checks;
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
  distribution.open_interval = distribution.open_interval || options.open_interval;
  Report report;
  if (options.samples > 0) {
    report = check_subject(make_subject(distribution), statistics(options));
    name_float(distribution, options.seed, report);
  } else {
    report.subject = distribution.name;
    report.alpha = options.alpha;
  }
  for (Check& check : check_deterministic_laws(distribution, options, &report.untried))
    report.checks.push_back(std::move(check));
  if (distribution.ns_per_sample) report.ns_per_sample = distribution.ns_per_sample();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc
