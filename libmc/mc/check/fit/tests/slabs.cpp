#include <mc/check/fit/tests/slabs.h>

#include <mc/check/fit/alpha_shares.h>
#include <mc/check/fit/expected/cubature.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mc {
namespace {

// The place on an axis where most samples share one value, up to rounding.
bool find_atom(const Subject& s, const std::vector<Subject::Coordinates>& pilot, const std::vector<double>& v,
               Slab& slab) {
  const std::size_t axis = slab.axis;
  const auto width = [&](double a) { return 64 * s.epsilon * std::abs(a) + 1e-300; };
  double at = 0;
  for (std::size_t i = 0, j = 0; i < v.size(); ++i) {
    while (j < v.size() && v[j] <= v[i] + width(v[i])) ++j;
    if (j - i > slab.pilot_count) {
      slab.pilot_count = j - i;
      at = v[i];
    }
  }
  if (slab.pilot_count < 4) return false;
  double blur = width(at);
  if (s.resolution) {
    int seen = 0;
    for (const auto& p : pilot)
      if (p[axis] >= at && p[axis] <= at + width(at) && seen++ < 16)
        blur = std::max(blur, 8 * s.resolution(p, static_cast<int>(axis)));
  }
  slab.box.lo[axis] = std::max(at - blur, 0.0);
  slab.box.hi[axis] = std::min(at + 2 * blur, 1.0);
  return slab.box.hi[axis] > slab.box.lo[axis];
}

// The widest gap of a place on an axis, in spacings of the 64 samples around it. Exponential spacings are seldom more
// than 16 times their mean, so that a right sampler rarely pays for the test.
enum class Place : std::uint8_t { low_end, inside, high_end };

bool find_gap(const Subject& s, const std::vector<double>& v, Place place, Slab& slab) {
  constexpr std::ptrdiff_t around = 32;
  const auto n = static_cast<std::ptrdiff_t>(v.size());
  if (n < 4 * around) return false;
  const std::ptrdiff_t from = place == Place::low_end ? -1 : place == Place::inside ? 0 : n - 1;
  const std::ptrdiff_t to = place == Place::low_end ? -1 : place == Place::inside ? n - 2 : n - 1;
  const auto at = [&](std::ptrdiff_t i) { return i < 0 ? 0.0 : i >= n ? 1.0 : v[static_cast<std::size_t>(i)]; };
  double widest = 16;
  std::ptrdiff_t below = -2;
  for (std::ptrdiff_t i = from; i <= to; ++i) {
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(i - around, 0), last = std::min(i + 1 + around, n - 1);
    // Rounding may carry samples just out of the chart, where nothing is claimed.
    if (at(i) < 0 || at(i + 1) > 1) continue;
    const double gap = at(i + 1) - at(i), inside = i >= 0 && i + 1 < n ? gap : 0;
    const double spacing = (at(last) - at(first) - inside) / static_cast<double>(last - first - (inside > 0 ? 1 : 0));
    if (gap > widest * spacing && gap > 1e4 * s.epsilon) widest = gap / spacing, below = i;
  }
  if (below < -1) return false;
  const double margin = (at(below + 1) - at(below)) / 64; // the samples at its edges are not of the gap
  slab.box.lo[slab.axis] = below < 0 ? 0.0 : at(below) + margin;
  slab.box.hi[slab.axis] = below + 1 >= n ? 1.0 : at(below + 1) - margin;
  return true;
}

// Whether the points beside a gap are rounded to steps as wide as it is.
bool is_rounding(const Subject& s, const std::vector<Subject::Coordinates>& pilot, const Slab& gap) {
  if (!s.resolution) return false;
  const std::size_t axis = gap.axis;
  const double lo = gap.box.lo[axis], hi = gap.box.hi[axis], middle = (lo + hi) / 2;
  const auto nearest = std::min_element(pilot.begin(), pilot.end(), [&](const auto& a, const auto& b) {
    return std::abs(a[axis] - middle) < std::abs(b[axis] - middle);
  });
  return hi - lo <= 16 * s.resolution(*nearest, static_cast<int>(axis));
}

} // namespace

std::vector<Slab> suspect_slabs(const Subject& s, const std::vector<Subject::Coordinates>& pilot,
                                const std::array<std::vector<double>, 3>& sorted) {
  std::vector<Slab> slabs;
  const auto add = [&](Slab slab) {
    slab.pieces = {slab.box};
    for (std::size_t other = 0; other < static_cast<std::size_t>(s.dim); ++other) {
      if (other == slab.axis) continue;
      const std::size_t cuts = s.dim == 2 ? 64 : 16;
      std::vector<UnitBox> finer;
      for (UnitBox piece : slab.pieces) {
        for (std::size_t k = 1; k < cuts; ++k) {
          const double cut = sorted[other][k * sorted[other].size() / cuts];
          if (!(cut > piece.lo[other] && cut < piece.hi[other])) continue;
          finer.push_back(piece);
          finer.back().hi[other] = piece.lo[other] = cut;
        }
        finer.push_back(piece);
      }
      slab.pieces = std::move(finer);
    }
    slabs.push_back(std::move(slab));
  };
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    Slab atom;
    atom.axis = axis;
    if (find_atom(s, pilot, sorted[axis], atom)) add(std::move(atom));
    for (const Place place : {Place::low_end, Place::inside, Place::high_end}) {
      Slab gap;
      gap.kind = Slab::Kind::gap;
      gap.axis = axis;
      if (find_gap(s, sorted[axis], place, gap) && !is_rounding(s, pilot, gap)) add(std::move(gap));
    }
  }
  return slabs;
}

void integrate_slabs(const Subject& s, std::vector<Slab>& slabs, double n, std::size_t max_evaluations) {
  for (Slab& slab : slabs) {
    CubatureGoal goal;
    goal.total_error = 0.1 / n;
    goal.box_error = [&](double value) {
      return std::max(0.1 / n / static_cast<double>(slab.pieces.size()), 0.01 * value);
    };
    goal.max_evaluations = max_evaluations;
    const auto [value, error] = integrate_boxes(s.density, s.dim, slab.pieces, goal).total;
    slab.mass = value;
    slab.error = error;
  }
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
  const double family = atom ? s.dim : 3 * s.dim;
  double least_sure = 1; // p where the error of the mass is conceded
  for (const Slab& slab : slabs) {
    if (slab.kind != kind) continue;
    const double share = static_cast<double>(slab.observed) / n, claimed = atom ? slab.mass : slab.mass / mass;
    if (atom ? share <= claimed : share >= claimed) continue;
    const double conceded = atom ? std::min(claimed + slab.error, share) : std::max(claimed - slab.error, share);
    const auto tail = [&](double p) {
      return sidak(binomial_tail(slab.observed, static_cast<std::uint64_t>(n), std::min(p, 1.0)), family);
    };
    least_sure = std::min(least_sure, tail(conceded));
    const bool material = n * slab.error > 0.5 * std::sqrt(std::max(n * claimed, 1.0));
    const double p = tail(material ? claimed : conceded);
    if (p >= *c.p) continue;
    c.p = p;
    c.statistic = static_cast<double>(slab.observed);
    c.detail = fmt::format("{} samples, {:.3g} expected, with coordinate {} of the chart in [{:.17g}, {:.17g}]",
                           slab.observed, n * claimed, slab.axis, slab.box.lo[slab.axis], slab.box.hi[slab.axis]);
  }
  const double level = sidak_level(alpha, c.share);
  if (least_sure <= level) c.verdict = Verdict::fail;
  else if (*c.p <= level) c.verdict = Verdict::inconclusive;
  if (c.verdict == Verdict::pass) c.detail.clear();
  return c;
}

} // namespace mc
