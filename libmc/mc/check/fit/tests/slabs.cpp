#include <mc/check/fit/tests/slabs.h>

#include <mc/check/fit/alpha_shares.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

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

// Where samples share one value, up to rounding: the place on an axis where most of them do, and both its ends.
void add_atoms(const Subject& s, const Pilot& pilot, const std::vector<double>& v, std::size_t axis,
               std::vector<Slab>& atoms) {
  const auto beyond = [&](double a) { return a + 64 * s.epsilon * std::abs(a) + 1e-300; };
  const std::size_t n = v.size();
  std::size_t most = 1, place = 0, pairs = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double end = beyond(v[i]);
    if (v[i + 1] > end) continue; // nearly always
    ++pairs;
    for (; i + most < n && v[i + most] <= end; ++most) place = i;
  }
  const auto add = [&](std::size_t first, std::size_t count, bool end) {
    Slab atom;
    atom.axis = axis;
    atom.at_end = end;
    atom.equal = static_cast<double>(count);
    atom.pairs_elsewhere = static_cast<double>(pairs + 1 - count);
    const double at = v[first];
    double blur = beyond(at) - at;
    for (const std::uint32_t i : s.resolution ? pilot.nearest(axis, at, 16) : std::vector<std::uint32_t>{}) {
      Subject::Coordinates p = pilot.points[i];
      p[axis] = at;
      blur = std::max(blur, 8 * s.resolution(p, static_cast<int>(axis)));
    }
    atom.box.lo[axis] = std::max(at - blur, 0.0);
    atom.box.hi[axis] = std::min(at + 2 * blur, 1.0);
    atom.count = count_between(v, atom.box.lo[axis], atom.box.hi[axis]);
    if (atom.box.hi[axis] > atom.box.lo[axis]) atoms.push_back(atom);
  };
  std::size_t low = 0, high = 0; // how many
  while (low < n && v[low] <= beyond(v[0])) ++low;
  while (high < n && v[n - 1] <= beyond(v[n - 1 - high])) ++high;
  if (most >= 3) add(place, most, false);
  if (low >= 2) add(0, low, true);
  if (high >= 2) add(n - high, high, true);
}

// Samples that are rounded to steps are now and then equal, which makes no atom. How coarse the steps are, the pairs of
// equal samples elsewhere tell; one more than were seen are assumed. This is how often so many of n samples would then
// be equal at some place, or at one of the two ends. Steps coarser than those of 31 random bits, or of the scalar, are
// not assumed: such a sampler is at fault.
double chance_of_steps(const Subject& s, const Slab& atom, double n) {
  const double equal_to_one = std::min(2 * (atom.pairs_elsewhere + 1) / n, n * std::max(0x1p-31, s.epsilon));
  const double at_a_place = (atom.equal - 1) * std::log(equal_to_one);
  return std::exp(at_a_place + (atom.at_end ? std::log(2.0) : std::log(n) - std::lgamma(atom.equal + 1)));
}

// Gaps are numbered as the sample below them; gap -1 lies before the first sample.
struct Gaps {
  std::ptrdiff_t first, last;
};
enum class Place : std::uint8_t { low_end, inside, high_end };

Gaps gaps_at(Place place, std::ptrdiff_t samples) {
  switch (place) {
  case Place::low_end: return {-1, -1};
  case Place::inside: return {0, samples - 2};
  case Place::high_end: return {samples - 1, samples - 1};
  }
  return {0, -1};
}

// The widest gap of a place on an axis, in spacings of the 64 samples around it. Exponential spacings are seldom more
// than 16 times their mean, so that a right sampler rarely pays for the test.
bool find_gap(const Subject& s, const std::vector<double>& v, Place place, Slab& slab) {
  constexpr std::ptrdiff_t around = 32;
  const auto n = static_cast<std::ptrdiff_t>(v.size());
  if (n < 4 * around) return false;
  // The samples with the ends of the axis about them.
  const auto at = [&](std::ptrdiff_t i) {
    if (i < 0) return 0.0;
    return i < n ? v[static_cast<std::size_t>(i)] : 1.0;
  };
  const Gaps gaps = gaps_at(place, n);
  double widest = 16;
  std::ptrdiff_t below = -2;
  for (std::ptrdiff_t i = gaps.first; i <= gaps.last; ++i) {
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(i - around, 0), last = std::min(i + 1 + around, n - 1);
    // Rounding may carry samples just out of the chart, where nothing is claimed.
    if (at(i) < 0 || at(i + 1) > 1) continue;
    const double gap = at(i + 1) - at(i), inside = i >= 0 && i + 1 < n ? gap : 0;
    const double spacings = static_cast<double>(last - first - (inside > 0 ? 1 : 0));
    const double around_it = at(last) - at(first) - inside;
    if (!(gap * spacings > widest * around_it && gap > rounded_steps * s.epsilon)) continue;
    widest = gap * spacings / around_it;
    below = i;
  }
  if (below < -1) return false;
  const double margin = (at(below + 1) - at(below)) / 64; // the samples at its edges are not of the gap
  slab.box.lo[slab.axis] = below < 0 ? 0.0 : at(below) + margin;
  slab.box.hi[slab.axis] = below + 1 >= n ? 1.0 : at(below + 1) - margin;
  return true;
}

// Whether the points beside a gap are rounded to steps as wide as it is.
bool is_rounding(const Subject& s, const Pilot& pilot, const Slab& gap) {
  const double lo = gap.box.lo[gap.axis], hi = gap.box.hi[gap.axis];
  double step = 0;
  for (const std::uint32_t i : pilot.nearest(gap.axis, (lo + hi) / 2, 16))
    step = std::max(step, rounding(s, pilot.points[i], gap.axis));
  return hi - lo <= rounded_steps * step;
}

// The slab with the points of the pilot in it and beside it, and the mass that it would hold if it were like these.
Layer layer_around(const Pilot& pilot, const Slab& slab) {
  Layer layer{slab.axis, slab.box.lo[slab.axis], slab.box.hi[slab.axis], {}, 0, slab.kind == Slab::Kind::gap};
  constexpr double least = 64;
  const double inside = count_between(pilot.sorted[slab.axis], layer.lo, layer.hi);
  layer.near = pilot.nearest(slab.axis, 0.5 * (layer.lo + layer.hi), static_cast<std::size_t>(std::max(least, inside)));
  double lo = layer.lo, hi = layer.hi;
  for (const std::uint32_t i : layer.near) {
    lo = std::min(lo, pilot.points[i][slab.axis]);
    hi = std::max(hi, pilot.points[i][slab.axis]);
  }
  const double share = static_cast<double>(layer.near.size()) / static_cast<double>(pilot.points.size());
  layer.mass = share * (layer.hi - layer.lo) / (hi - lo);
  return layer;
}

} // namespace

std::vector<Slab> find_slabs(const Subject& s, const Pilot& pilot, const std::array<std::vector<double>, 3>& sorted) {
  std::vector<Slab> slabs;
  const auto add = [&](Slab slab) {
    slab.mass = slab_mass(s, pilot, layer_around(pilot, slab), slabs.size() + 1);
    slabs.push_back(slab);
  };
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    std::vector<Slab> atoms;
    add_atoms(s, pilot, sorted[axis], axis, atoms);
    for (const Slab& atom : atoms) add(atom);
    for (const Place place : {Place::low_end, Place::inside, Place::high_end}) {
      Slab gap;
      gap.kind = Slab::Kind::gap;
      gap.axis = axis;
      gap.at_end = place != Place::inside;
      if (find_gap(s, sorted[axis], place, gap) && !is_rounding(s, pilot, gap)) add(gap);
    }
  }
  return slabs;
}

Check test_slabs(const Subject& s, Slab::Kind kind, const std::vector<Slab>& slabs, double n, double mass,
                 double alpha) {
  const bool atom = kind == Slab::Kind::atom;
  Check c{atom ? "no atoms" : "no gaps",
          Verdict::pass,
          1.0,
          alpha_share(atom ? FitTest::atoms : FitTest::gaps, s.dim),
          0,
          0,
          atom ? Fault::atom : Fault::local,
          {}};
  for (const Slab& slab : slabs) {
    if (slab.kind != kind) continue;
    const double slack = 4 * std::sqrt(slab.mass.safe_variance()), share = slab.count / n;
    // Rounding moves samples by whole steps: twice as many as expected are no atom yet.
    const double claimed = atom ? 2 * (slab.mass.value + slack) : (slab.mass.value - slack) / mass;
    if (atom ? share <= claimed : share >= claimed) continue;
    // The slab lies where one sample is, or between two: that much is given. That sample is one of all, or one of two.
    // Gaps at the ends and inside share the chance evenly.
    const double family = (slab.at_end ? 2 : n) * s.dim * (atom ? 1 : 2);
    const double by_density = sidak(binomial_tail(atom ? slab.count - 1 : 0, n, std::min(claimed, 1.0)), family);
    const double p = std::min(by_density + (atom ? s.dim * chance_of_steps(s, slab, n) : 0.0), 1.0);
    if (p >= *c.p) continue;
    c.p = p;
    c.statistic = slab.count;
    c.detail = fmt::format("{} contains {} samples, {:.3g} expected",
                           describe_layer(s, slab.axis, slab.box.lo[slab.axis], slab.box.hi[slab.axis]), slab.count,
                           n * slab.mass.value);
  }
  if (*c.p <= sidak_level(alpha, c.share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

} // namespace mc
