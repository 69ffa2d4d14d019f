#include <mc/check/fit/tests/strips.h>

#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr std::size_t most_strips = 2048, most_runs = 64, most_integrated = 4;
constexpr int halvings = 6; // of the strips at both ends

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
    sort_points(pilot, axis);
    axes_.push_back(std::move(axis));
  }
}

void Strips::sort_points(const Pilot& pilot, Layers& axis) {
  std::vector<std::uint32_t> strip;
  strip.reserve(pilot.points.size());
  axis.first_points.resize(axis.strips.size() + 1);
  for (const Subject::Coordinates& v : pilot.points) {
    strip.push_back(static_cast<std::uint32_t>(axis.find(v[axis.index])));
    ++axis.first_points[strip.back() + 1];
  }
  std::partial_sum(axis.first_points.begin(), axis.first_points.end(), axis.first_points.begin());
  std::vector<std::uint32_t> next = axis.first_points;
  axis.points.resize(pilot.points.size());
  for (std::size_t i = 0; i < strip.size(); ++i) axis.points[next[strip[i]]++] = static_cast<std::uint32_t>(i);
}

Layer Strips::layer(const Run& run) const {
  constexpr std::size_t least = 64;
  const Layers& axis = axes_[run.axis];
  std::size_t first = run.first, last = run.last;
  const auto count = [&] { return axis.first_points[last] - axis.first_points[first]; };
  while (count() < std::min(least, axis.points.size())) {
    if (first > 0) --first;
    if (last < axis.strips.size()) ++last;
  }
  return {run.axis, run.lo,
          run.hi,   {axis.points.begin() + axis.first_points[first], axis.points.begin() + axis.first_points[last]},
          0,        false};
}

bool Strips::is_rounded(const Subject& s, const Pilot& pilot, const Run& run) const {
  double step = 0;
  for (const std::uint32_t i : pilot.nearest(run.axis, 0.5 * (run.lo + run.hi), 16))
    step = std::max(step, rounding(s, pilot.points[i], run.axis));
  if (step * rounded_steps > run.hi - run.lo) return true;
  const Layers& axis = axes_[run.axis];
  const auto samples_per_length = [&](std::size_t i) {
    const double lo = i > 0 ? axis.ends[i - 1] : 0.0, hi = i < axis.ends.size() ? axis.ends[i] : 1.0;
    return axis.strips[i].observed / (hi - lo);
  };
  // Beside a strip of few samples may stand a bright cell, of which a step holds more than all of the strip.
  double ends = 2 * run.compared.mean / (run.hi - run.lo);
  if (run.first > 0) ends = std::max(ends, samples_per_length(run.first - 1) + samples_per_length(run.first));
  if (run.last < axis.strips.size())
    ends = std::max(ends, samples_per_length(run.last - 1) + samples_per_length(run.last));
  return step * ends > std::sqrt(run.compared.mean);
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
                lo,
                lo + length,
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

// The p-value of a run's count against an integral of its own, whose error is conceded; against the random points where
// not all its samples count 1, and where these know better.
void Strips::Run::judge(const Subject& s, const Pilot& pilot, Layer layer, double n, double mass, Effort effort) {
  p = compared.p();
  expected = compared.expected;
  if (counts.observed_squares != counts.observed) return;
  layer.mass = mass * counts.observed / n;
  const EstimatedMass own = slab_mass(s, pilot, layer, 1, effort);
  const double integrated = n * own.value / mass, error = n * std::sqrt(own.safe_variance()) / mass;
  const double error_of_points = std::sqrt(compared.point_variance * std::max(compared.observed, compared.expected));
  // An integral that met nothing, or that the random points contradict, missed where the mass lies.
  const double off = std::abs(integrated - compared.expected);
  if (!(own.value > 0 && error <= error_of_points && off <= 4 * error + 3 * error_of_points)) return;
  expected = integrated;
  const double slack = 4 * error, excess = counts.observed - expected;
  const double conceded =
      excess > 0 ? std::min(expected + slack, counts.observed) : std::max(expected - slack, counts.observed);
  p = binomial_tail(counts.observed, n, std::min(conceded / n, 1.0));
}

Check Strips::test(const Subject& s, const Pilot& pilot, double n, double mass, double share, double alpha) const {
  Check c{"marginal bins", Verdict::pass, 1.0, share, 0, 0, Fault::local, {}};
  double least = 1, family = 0;
  std::vector<Run> runs = farthest_runs(family);
  for (Run& run : runs) run.judge(s, pilot, layer(run), n, mass, Effort::quick);
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.p < b.p; });
  std::size_t integrated = 0;
  for (Run& run : runs) {
    if (integrated == most_integrated) break;
    if (is_rounded(s, pilot, run)) continue;
    run.judge(s, pilot, layer(run), n, mass, Effort::full);
    ++integrated;
    if (run.p >= least) continue;
    least = run.p;
    c.statistic = run.compared.z();
    c.detail = fmt::format("{} contains {:.0f} samples, {:.1f} expected", describe_layer(s, run.axis, run.lo, run.hi),
                           run.counts.observed, run.expected);
  }
  c.p = sidak(least, family);
  if (*c.p <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

} // namespace mc
