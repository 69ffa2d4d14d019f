#include <mc/check/laws.h>

#include <mc/check/subject/float_steps.h>

#include <chrono>

namespace mc {

// A law is one file of laws/ and one row here.
Law edges_law, batches_law, support_law, jacobian_law, precision_law;
constexpr Law* laws[] = {edges_law, purity_law, batches_law, support_law, inverse_law, jacobian_law, precision_law};

std::vector<Check> check_deterministic(const AnySampler& sampler, const LawOptions& options) {
  std::vector<Check> checks;
  for (Law* law : laws)
    for (Check& check : law(sampler, options)) checks.push_back(std::move(check));
  return checks;
}

AnySampler within(AnySampler sampler, const LawOptions& options) {
  sampler.mass_tolerance = options.mass_eps * sampler.epsilon();
  sampler.invert_tolerance = options.invert_eps * sampler.epsilon();
  return sampler;
}

namespace {

// Where counts are wrong since something is rounded to float, the first of them says so.
void name_float(const AnySampler& sampler, std::uint64_t seed, Report& report) {
  for (Check& c : report.checks) {
    if (c.verdict != Verdict::fail || !c.p) continue;
    const std::string cause = float_steps(sampler, seed);
    if (!cause.empty()) c.detail += (c.detail.empty() ? "" : "; ") + cause;
    return;
  }
}

} // namespace

Report check_laws(const AnySampler& original, const LawOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AnySampler sampler = original;
  sampler.open_interval = sampler.open_interval || options.open_interval;
  Report report;
  if (options.samples > 0) {
    report = check_subject(make_subject(sampler), statistics(options));
    name_float(sampler, options.seed, report);
  } else {
    report.subject = sampler.name;
    report.alpha = options.alpha;
  }
  for (Check& check : check_deterministic(sampler, options)) report.checks.push_back(std::move(check));
  if (sampler.ns_per_sample) report.ns_per_sample = sampler.ns_per_sample();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc
