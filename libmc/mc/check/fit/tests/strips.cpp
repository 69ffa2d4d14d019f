#include <mc/check/fit/tests/strips.h>

#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

constexpr std::size_t most_strips = 2048, most_runs = 64, most_integrated = 4;
constexpr int halvings = 6; // of the strips at both ends

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
      for (int k = 1; k <= halvings; ++k) {
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
  std::vector<Run> runs, ends;
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
        run.expected = run.compared.expected;
        family += 1;
        // The random points may hide what is wrong with the thin ends.
        if (length <= 8 && (lo == 0 || lo + length == size)) ends.push_back(run);
        else if (std::abs(run.compared.z()) >= 2) runs.push_back(run);
      }
  }
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return std::abs(a.compared.z()) > std::abs(b.compared.z()); });
  if (runs.size() > most_runs) runs.resize(most_runs);
  runs.insert(runs.end(), ends.begin(), ends.end());
  return runs;
}

// The p-value of a run's count against an integral of its own, whose error is conceded, where all its samples count 1;
// else against the random points.
void Strips::Run::judge(const Subject& s, const Pilot& pilot, double n, double mass, Effort effort) {
  p = compared.p();
  if (counts.observed_squares != counts.observed) return;
  UnitBox box;
  box.lo[axis] = lo;
  box.hi[axis] = hi;
  const EstimatedMass own = slab_mass(s, pilot, axis, box, 1, effort);
  const double integrated = n * own.value / mass, slack = 4 * n * std::sqrt(own.safe_variance()) / mass;
  // An integral that met nothing, or that the random points contradict, missed where the mass lies.
  const double by_points = 3 * std::sqrt(compared.point_variance * std::max(compared.observed, compared.expected));
  if (!(own.value > 0 && std::abs(integrated - compared.expected) <= slack + by_points)) return;
  expected = integrated;
  const double excess = counts.observed - expected;
  const double conceded =
      excess > 0 ? std::min(expected + slack, counts.observed) : std::max(expected - slack, counts.observed);
  p = binomial_tail(counts.observed, n, std::min(conceded / n, 1.0));
}

Check Strips::test(const Subject& s, const Pilot& pilot, double n, double mass, double share, double alpha) const {
  Check c{"strips", Verdict::pass, 1.0, share, 0, 0, Fault::local, {}};
  double least = 1, family = 0;
  std::vector<Run> runs = farthest_runs(family);
  for (Run& run : runs) run.judge(s, pilot, n, mass, Effort::quick);
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.p < b.p; });
  std::size_t integrated = 0;
  for (Run& run : runs) {
    if (integrated == most_integrated) break;
    if (is_rounded(s, pilot, run.axis, run.lo, run.hi, run.compared.mean)) continue;
    run.judge(s, pilot, n, mass, Effort::full);
    ++integrated;
    if (run.p >= least) continue;
    least = run.p;
    c.statistic = run.compared.z();
    c.detail = fmt::format("{:.0f} samples, {:.1f} expected, with {}", run.counts.observed, run.expected,
                           describe_range(s.axes, run.axis, run.lo, run.hi));
  }
  c.p = sidak(least, family);
  if (*c.p <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

} // namespace mc
