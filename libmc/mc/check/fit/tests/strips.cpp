#include <mc/check/fit/tests/strips.h>

#include <mc/check/fit/tests/slabs.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

constexpr std::size_t most_strips = 2048, most_runs = 16;

// Whether rounding may explain the count of a strip.
bool is_rounded(const Subject& s, const Pilot& pilot, std::size_t axis, double lo, double hi, double count) {
  double step = 0;
  for (const Subject::Coordinates& p : pilot.nearest(axis, 0.5 * (lo + hi)))
    step = std::max(step, rounding(s, p, axis));
  return step * std::max(rounded_steps, 2 * std::sqrt(count)) > hi - lo;
}

} // namespace

Strips::Strips(const Pilot& pilot, int dim) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
    const std::vector<double>& sorted = pilot.sorted[d];
    Layers axis;
    axis.index = d;
    const std::size_t count = std::clamp<std::size_t>(sorted.size() / 32, 1, most_strips);
    for (std::size_t k = 1; k < count; ++k) axis.ends.push_back(sorted[k * sorted.size() / count]);
    if (!axis.ends.empty()) {
      const double first = axis.ends.front(), last = 1 - axis.ends.back();
      for (int k = 1; k <= 6; ++k) {
        axis.ends.push_back(std::ldexp(first, -k));
        axis.ends.push_back(1 - std::ldexp(last, -k));
      }
    }
    std::sort(axis.ends.begin(), axis.ends.end());
    axis.ends.erase(std::unique(axis.ends.begin(), axis.ends.end()), axis.ends.end());
    axis.strips.resize(axis.ends.size() + 1);
    for (std::size_t k = 0; k <= Layers::buckets; ++k) {
      const double v = static_cast<double>(k) / static_cast<double>(Layers::buckets);
      axis.guide.push_back(
          static_cast<std::uint32_t>(std::upper_bound(axis.ends.begin(), axis.ends.end(), v) - axis.ends.begin()));
    }
    axes_.push_back(std::move(axis));
  }
}

std::vector<Strips::Run> Strips::farthest_runs(double& family) const {
  std::vector<Run> runs;
  for (const Layers& axis : axes_) {
    WeightedCounts all;
    for (const WeightedCounts& strip : axis.strips) all.join(strip);
    if (!(all.observed > 0 && all.expected > 0)) continue;
    const double scale = all.observed / all.expected;
    const std::size_t size = axis.strips.size();
    for (std::size_t length = 1; 2 * length <= size; length *= 2)
      for (std::size_t lo = 0; lo + length <= size; lo += std::max<std::size_t>(length / 2, 1)) {
        Run run{axis.index,
                lo > 0 ? axis.ends[lo - 1] : 0.0,
                lo + length < size ? axis.ends[lo + length - 1] : 1.0,
                {},
                {}};
        for (std::size_t i = lo; i < lo + length; ++i) run.counts.join(axis.strips[i]);
        run.compared = compare(run.counts, scale);
        family += 1;
        if (std::abs(run.compared.z()) >= 3) runs.push_back(run);
      }
  }
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return std::abs(a.compared.z()) > std::abs(b.compared.z()); });
  if (runs.size() > most_runs) runs.resize(most_runs);
  return runs;
}

Check Strips::test(const Subject& s, const Pilot& pilot, double n, double mass, double share, double alpha) const {
  Check c{"strips", Verdict::pass, 1.0, share, 0, 0, Fault::local, {}};
  double least = 1, family = 0;
  for (const Run& run : farthest_runs(family)) {
    if (is_rounded(s, pilot, run.axis, run.lo, run.hi, run.compared.mean)) continue;
    double p = run.compared.p(), expected = run.compared.expected;
    if (run.counts.observed_squares == run.counts.observed) {
      UnitBox box;
      box.lo[run.axis] = run.lo;
      box.hi[run.axis] = run.hi;
      const EstimatedMass own = slab_mass(s, pilot, run.axis, box, 1);
      expected = n * own.value / mass;
      const double slack = 4 * n * std::sqrt(own.safe_variance()) / mass, excess = run.counts.observed - expected;
      const double conceded = excess > 0 ? std::min(expected + slack, run.counts.observed)
                                         : std::max(expected - slack, run.counts.observed);
      p = binomial_tail(run.counts.observed, n, std::min(conceded / n, 1.0));
    }
    if (p >= least) continue;
    least = p;
    c.statistic = run.compared.z();
    c.detail = fmt::format("{:.0f} samples, {:.1f} expected, with coordinate {} of the chart in [{:.9g}, {:.9g}]",
                           run.counts.observed, expected, run.axis, run.lo, run.hi);
  }
  c.p = sidak(least, family);
  if (*c.p <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

} // namespace mc
