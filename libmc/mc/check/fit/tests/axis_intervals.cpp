#include <mc/check/fit/tests/axis_intervals.h>

#include <mc/check/fit/lattice.h>
#include <mc/check/fit/tests/fit_test.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <boost/math/special_functions/gamma.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mc {
namespace {

double count_between(const std::vector<double>& sorted, double lo, double hi) {
  return static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), hi) -
                             std::lower_bound(sorted.begin(), sorted.end(), lo));
}

// Returns the number of samples per length of the axis around `count` equal samples, which do not count.
double samples_per_length(const std::vector<double>& v, std::size_t first, std::size_t count) {
  constexpr std::size_t around = 256;
  const std::size_t lo = first > around ? first - around : 0, hi = std::min(first + count + around, v.size()) - 1;
  return v[hi] > v[lo] ? static_cast<double>(hi - lo + 1 - count) / (v[hi] - v[lo]) : 0.0;
}

// Adds the atoms of an axis: the most frequent value up to rounding, and the values at both ends.
void add_atoms(const Subject& s, const Pilot& pilot, const std::vector<double>& v, std::size_t axis,
               std::vector<AxisInterval>& atoms) {
  const auto beyond = [&](double a) { return a + 64 * s.epsilon * std::abs(a) + 1e-300; };
  const std::size_t n = v.size();
  std::size_t most = 1, position = 0, pairs = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double end = beyond(v[i]);
    if (v[i + 1] > end) continue; // true for nearly all samples
    ++pairs;
    for (; i + most < n && v[i + most] <= end; ++most) position = i;
  }
  const auto add = [&](std::size_t first, std::size_t count, bool end) {
    AxisInterval atom;
    atom.axis = axis;
    atom.at_end = end;
    atom.equal = static_cast<double>(count);
    atom.pairs_elsewhere = static_cast<double>(pairs + 1 - count);
    const double at = v[first];
    atom.per_length = samples_per_length(v, first, count);
    double blur = beyond(at) - at;
    for (const std::uint32_t i : s.resolution ? pilot.nearest(axis, at, 16) : std::vector<std::uint32_t>{}) {
      Subject::Coordinates p = pilot.points[i];
      p[axis] = at;
      blur = std::max(blur, 8 * s.resolution(p, static_cast<int>(axis)));
    }
    // Near an end the density may be an average over a layer of this width.
    if (std::min(at, 1 - at) < min_resolved_steps / 8 * blur) blur *= min_resolved_steps / 8;
    atom.box.lo[axis] = std::max(at - blur, 0.0);
    atom.box.hi[axis] = std::min(at + 2 * blur, 1.0);
    atom.count = count_between(v, atom.box.lo[axis], atom.box.hi[axis]);
    if (atom.box.hi[axis] > atom.box.lo[axis]) atoms.push_back(atom);
  };
  std::size_t low = 0, high = 0; // numbers of samples equal to the smallest and to the largest
  while (low < n && v[low] <= beyond(v[0])) ++low;
  while (high < n && v[n - 1] <= beyond(v[n - 1 - high])) ++high;
  if (most >= 3) add(position, most, false);
  if (low >= 2) add(0, low, true);
  if (high >= 2) add(n - high, high, true);
}

// Samples that are rounded to steps are sometimes equal without an atom. The number of equal pairs elsewhere, plus one,
// estimates the width of the steps. Returns the expected number of places where rounding makes atom.equal of n samples
// equal: anywhere on the axis, or at one of the two ends. The steps are at most as coarse as rounding explains; coarser
// steps are a fault.
double chance_of_steps(const Subject& s, const AxisInterval& atom, double n) {
  const double widest = std::max(n * std::max(0x1p-31, s.epsilon), atom.per_length * widest_lattice_step(s.epsilon));
  const double equal_to_one = std::min(2 * (atom.pairs_elsewhere + 1) / n, widest);
  const double at_a_place = (atom.equal - 1) * std::log(equal_to_one);
  // std::lgamma writes the global signgam, and so may not be called by several threads.
  return std::exp(at_a_place + (atom.at_end ? std::log(2.0) : std::log(n) - boost::math::lgamma(atom.equal + 1)));
}

// A gap has the index of the sample below it; gap -1 is before the first sample.
struct Gaps {
  std::ptrdiff_t first, last;
};
enum class GapPosition : std::uint8_t { low_end, inside, high_end };

Gaps gaps_at(GapPosition position, std::ptrdiff_t samples) {
  switch (position) {
  case GapPosition::low_end: return {-1, -1};
  case GapPosition::inside: return {0, samples - 2};
  case GapPosition::high_end: return {samples - 1, samples - 1};
  }
  return {0, -1};
}

// Finds the widest gap at a position on an axis, measured in spacings of the 64 samples around it. Exponential spacings
// rarely exceed 16 times their mean, so a correct distribution rarely needs the test.
bool find_gap(const Subject& s, const std::vector<double>& v, GapPosition position, AxisInterval& interval) {
  constexpr std::ptrdiff_t around = 32;
  const auto n = static_cast<std::ptrdiff_t>(v.size());
  if (n < 4 * around) return false;
  // Sample i, with the ends of the axis before the first and after the last.
  const auto at = [&](std::ptrdiff_t i) {
    if (i < 0) return 0.0;
    return i < n ? v[static_cast<std::size_t>(i)] : 1.0;
  };
  const Gaps gaps = gaps_at(position, n);
  double widest = 16;
  std::ptrdiff_t below = -2;
  for (std::ptrdiff_t i = gaps.first; i <= gaps.last; ++i) {
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(i - around, 0), last = std::min(i + 1 + around, n - 1);
    // Rounding may move samples slightly outside the chart, where the density is not defined.
    if (at(i) < 0 || at(i + 1) > 1) continue;
    const double gap = at(i + 1) - at(i), inside = i >= 0 && i + 1 < n ? gap : 0;
    const double spacings = static_cast<double>(last - first - (inside > 0 ? 1 : 0));
    const double around_it = at(last) - at(first) - inside;
    if (!(gap * spacings > widest * around_it && gap > min_resolved_steps * s.epsilon)) continue;
    widest = gap * spacings / around_it;
    below = i;
  }
  if (below < -1) return false;
  const double margin = (at(below + 1) - at(below)) / 64; // excludes the samples at the edges of the gap
  interval.box.lo[interval.axis] = below < 0 ? 0.0 : at(below) + margin;
  interval.box.hi[interval.axis] = below + 1 >= n ? 1.0 : at(below + 1) - margin;
  return true;
}

// Whether the points next to a gap are rounded to steps of the width of the gap.
bool is_rounding(const Subject& s, const Pilot& pilot, const AxisInterval& gap) {
  const double lo = gap.box.lo[gap.axis], hi = gap.box.hi[gap.axis];
  double step = 0;
  for (const std::uint32_t i : pilot.nearest(gap.axis, (lo + hi) / 2, 16))
    step = std::max(step, rounding_step(s, pilot.points[i], gap.axis));
  return hi - lo <= min_resolved_steps * step;
}

// Returns the interval with the pilot points inside and next to it, and with its mass for a density constant across
// these points.
IntervalQuery query_around(const Pilot& pilot, const AxisInterval& interval) {
  IntervalQuery query{interval.axis,
                      interval.box.lo[interval.axis],
                      interval.box.hi[interval.axis],
                      {},
                      0,
                      interval.kind == AxisInterval::Kind::gap};
  constexpr double least = 64;
  const double inside = count_between(pilot.sorted[interval.axis], query.lo, query.hi);
  query.near =
      pilot.nearest(interval.axis, 0.5 * (query.lo + query.hi), static_cast<std::size_t>(std::max(least, inside)));
  double lo = query.lo, hi = query.hi;
  for (const std::uint32_t i : query.near) {
    lo = std::min(lo, pilot.points[i][interval.axis]);
    hi = std::max(hi, pilot.points[i][interval.axis]);
  }
  const double share = static_cast<double>(query.near.size()) / static_cast<double>(pilot.points.size());
  query.mass = share * (query.hi - query.lo) / (hi - lo);
  return query;
}

} // namespace

std::vector<AxisInterval> find_axis_intervals(const Subject& s, const Pilot& pilot,
                                              const PerAxis<std::vector<double>>& sorted) {
  std::vector<AxisInterval> intervals;
  const auto add = [&](AxisInterval interval) {
    interval.mass = interval_mass(s, pilot, query_around(pilot, interval), intervals.size() + 1);
    intervals.push_back(interval);
  };
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    std::vector<AxisInterval> atoms;
    add_atoms(s, pilot, sorted[axis], axis, atoms);
    for (const AxisInterval& atom : atoms) add(atom);
    for (const GapPosition position : {GapPosition::low_end, GapPosition::inside, GapPosition::high_end}) {
      AxisInterval gap;
      gap.kind = AxisInterval::Kind::gap;
      gap.axis = axis;
      gap.at_end = position != GapPosition::inside;
      if (find_gap(s, sorted[axis], position, gap) && !is_rounding(s, pilot, gap)) add(gap);
    }
  }
  return intervals;
}

Check test_axis_intervals(const Subject& s, AxisInterval::Kind kind, const std::vector<AxisInterval>& intervals,
                          double n, double mass, double alpha_share, double alpha) {
  const bool atom = kind == AxisInterval::Kind::atom;
  Check c{atom ? "no atoms" : "no gaps", Verdict::pass, 1.0, alpha_share, 0, 0, atom ? Fault::atom : Fault::local, {}};
  for (const AxisInterval& interval : intervals) {
    if (interval.kind != kind) continue;
    const double slack = 4 * std::sqrt(interval.mass.worst_case_variance()), share = interval.count / n;
    // Rounding moves samples by whole steps: twice the expected number is not yet an atom.
    const double claimed = atom ? 2 * (interval.mass.value + slack) : (interval.mass.value - slack) / mass;
    if (atom ? share <= claimed : share >= claimed) continue;
    // The interval is chosen at one sample, or between two: these samples are given. The choice is among n samples, or
    // among the two ends. Gaps at the ends and inside share the probability evenly.
    const double family = (interval.at_end ? 2 : n) * s.dim * (atom ? 1 : 2);
    const double by_density = sidak(binomial_tail(atom ? interval.count - 1 : 0, n, std::min(claimed, 1.0)), family);
    const double p = std::min(by_density + (atom ? s.dim * chance_of_steps(s, interval, n) : 0.0), 1.0);
    if (p >= *c.p) continue;
    c.p = p;
    c.statistic = interval.count;
    c.detail =
        fmt::format("{} contains {} samples, {:.3g} expected",
                    describe_interval(s, interval.axis, interval.box.lo[interval.axis], interval.box.hi[interval.axis]),
                    interval.count, n * interval.mass.value);
  }
  if (*c.p <= sidak_level(alpha, c.share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

namespace {

FitTest test_of(AxisInterval::Kind kind, double share) {
  return {.judge = [=](const FitCounts& counts) {
    const FitSetup& setup = counts.setup;
    return Findings{{test_axis_intervals(setup.subject, kind, counts.intervals, counts.kept, counts.total(), share,
                                         setup.options.alpha)}};
  }};
}

} // namespace

FitTest atoms_test(const FitSetup&, double share) { return test_of(AxisInterval::Kind::atom, share); }

FitTest gaps_test(const FitSetup&, double share) { return test_of(AxisInterval::Kind::gap, share); }

} // namespace mc
