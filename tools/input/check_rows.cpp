#include <input/check_rows.h>

#include <mc/check/fit/tests/independence.h>
#include <mc/random/hash.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>

namespace carlo {

mc::Report check_rows(const mc::Subject& subject, const OrderedSamples& samples, bool dependent,
                      const mc::SubjectOptions& options, const DependenceWords& words) {
  if (dependent) {
    mc::Report report = check_subject(subject, options);
    report.untried.push_back({"independence of the samples", words.option});
    return report;
  }
  constexpr double of_order = 0.03, of_evenness = 0.02, rest = 1 - of_order - of_evenness;
  mc::SubjectOptions others = options;
  others.alpha = mc::sidak_level(options.alpha, rest);
  mc::Report report = check_subject(subject, others);
  report.alpha = options.alpha;
  for (mc::Check& c : report.checks) c.share *= rest;
  const auto append = [&](std::vector<mc::Check> checks) {
    for (mc::Check& c : checks) {
      if (c.verdict == mc::Verdict::fail) c.detail += "; " + words.remedy;
      report.checks.push_back(std::move(c));
    }
  };
  append(test_order(samples.points, samples.axes, samples.dim, mc::hash(options.seed, 7), of_order, options.alpha));
  // Dependent samples make the other tests fail, too: then the order is the cause.
  std::stable_partition(report.checks.begin(), report.checks.end(), [](const mc::Check& c) {
    return c.fault == mc::Fault::dependent && c.verdict == mc::Verdict::fail;
  });
  if (samples.probabilities.empty()) return report;
  std::vector<double> counts(samples.probabilities.size());
  for (const mc::Subject::Coordinates& v : samples.points) counts[static_cast<std::size_t>(v[0])] += 1;
  append(mc::test_evenness(counts, samples.probabilities, of_evenness, options.alpha));
  return report;
}

} // namespace carlo
