#include <mc/check/fit/expected/interval_mass.h>

#include <mc/check/report/report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace mc {
namespace {

constexpr std::size_t points_of_box = 4, most_near = 1024, most_pieces = 2048;
constexpr double over_samples = 4, over_seen = 4; // densities that indicate missed mass
constexpr int most_halvings = 64;                 // number of successive halvings
constexpr double boxes_per_axis = 512;            // in an interval, for each dimension up to the fourth

struct NearPoint {
  Subject::Coordinates v; // clamped to the layer
  double density;
};
using NearPoints = std::span<NearPoint>;

struct Piece {
  UnitBox box;
  NearPoints points;
};

// Returns the near points. The densities of points next to the layer are scaled by the ratio of the sample densities
// inside and around the layer.
std::vector<NearPoint> near_points(const Pilot& pilot, const IntervalQuery& query) {
  std::vector<NearPoint> points;
  double lo = query.lo, hi = query.hi;
  const std::size_t stride = (query.near.size() + most_near - 1) / most_near;
  for (std::size_t i = 0; i < query.near.size(); i += stride) {
    NearPoint p{pilot.points[query.near[i]], pilot.densities[query.near[i]]};
    lo = std::min(lo, p.v[query.axis]);
    hi = std::max(hi, p.v[query.axis]);
    p.v[query.axis] = std::clamp(p.v[query.axis], query.lo, query.hi);
    points.push_back(p);
  }
  if (hi - lo > query.hi - query.lo) {
    const double share = static_cast<double>(query.near.size()) / static_cast<double>(pilot.points.size());
    const double crowded = query.mass / (query.hi - query.lo) * (hi - lo) / share;
    for (NearPoint& p : points) p.density *= crowded;
  }
  return points;
}

// Cuts the layer. Each cut uses the axis along which the box is widest in ranks of the pilot, among the axes that
// rounding allows.
struct Cutter {
  const Subject& subject;
  const Pilot& pilot;
  double mass_of_point;
  std::vector<Piece> pieces{};

  void cut(const UnitBox& box, const UnitBox& ranks, NearPoints points, int halvings) {
    PerAxis<std::size_t> axes{0, 1, 2, 3, 4, 5};
    const auto width = [&](std::size_t axis) { return ranks.hi[axis] - ranks.lo[axis]; };
    std::stable_sort(axes.begin(), axes.begin() + subject.dim,
                     [&](std::size_t a, std::size_t b) { return width(a) > width(b); });
    const bool many = points.size() > points_of_box;
    const bool halve = halvings < most_halvings && pieces.size() < most_pieces && is_hidden(box, points);
    for (std::size_t i = 0; (many || halve) && i < static_cast<std::size_t>(subject.dim); ++i) {
      const std::size_t axis = axes[i];
      if (const double at = many ? middle(points, axis) : box.lo[axis]; may_split_at(box, axis, at, points))
        return cut_at(box, ranks, points, axis, at, halvings);
      if (const double at = 0.5 * (box.lo[axis] + box.hi[axis]); halve && may_split_at(box, axis, at, points))
        return cut_at(box, ranks, points, axis, at, halvings + 1);
    }
    pieces.push_back({box, points});
  }

  bool may_split_at(const UnitBox& box, std::size_t axis, double at, NearPoints points) const {
    return at > box.lo[axis] && at < box.hi[axis] && may_split(subject, box, axis, at, points[points.size() / 2].v);
  }

  void cut_at(const UnitBox& box, const UnitBox& ranks, NearPoints points, std::size_t axis, double at, int halvings) {
    const auto upper = std::partition(points.begin(), points.end(), [&](const NearPoint& p) { return p.v[axis] < at; });
    const auto below = static_cast<std::size_t>(upper - points.begin());
    UnitBox left = box, right = box, left_ranks = ranks, right_ranks = ranks;
    left.hi[axis] = right.lo[axis] = at;
    left_ranks.hi[axis] = right_ranks.lo[axis] = pilot.rank(axis, at);
    cut(left, left_ranks, points.first(below), halvings);
    cut(right, right_ranks, points.subspan(below), halvings);
  }

  static double middle(NearPoints points, std::size_t axis) {
    const auto less = [&](const NearPoint& a, const NearPoint& b) { return a.v[axis] < b.v[axis]; };
    const auto upper = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    std::nth_element(points.begin(), upper, points.end(), less);
    return 0.5 * (std::max_element(points.begin(), upper, less)->v[axis] + upper->v[axis]);
  }

  // Whether the density at a point claims far more mass for the box than the points in it represent.
  bool is_hidden(const UnitBox& box, NearPoints points) const {
    double claimed = 0;
    for (const NearPoint& p : points) claimed = std::max(claimed, p.density);
    return claimed * volume(box, subject.dim) > over_samples * mass_of_point * static_cast<double>(points.size() + 1);
  }
};

} // namespace

EstimatedMass interval_mass(const Subject& s, const Pilot& pilot, const IntervalQuery& query, std::uint64_t seed,
                            Effort effort) {
  UnitBox whole, ranks;
  whole.lo[query.axis] = query.lo;
  whole.hi[query.axis] = query.hi;
  ranks.lo[query.axis] = pilot.rank(query.axis, query.lo);
  ranks.hi[query.axis] = pilot.rank(query.axis, query.hi);
  std::vector<NearPoint> points = near_points(pilot, query);
  const double mass_of_point = query.mass / static_cast<double>(std::max<std::size_t>(points.size(), 1));
  Cutter cutter{s, pilot, mass_of_point};
  cutter.cut(whole, ranks, points, 0);

  const double less = effort == Effort::full ? 1 : 16;
  const double boxes = boxes_per_axis * std::ldexp(1.0, std::min(s.dim, 4) - 1) / less;
  const double per_axis = std::max(1.0, std::pow(boxes / static_cast<double>(cutter.pieces.size()), 1.0 / s.dim));
  Pcg random(seed);
  EstimatedMass mass;
  double missed = 0;
  for (const Piece& piece : cutter.pieces) {
    const BoxMaxima seen = add_box(s, piece.box, static_cast<std::size_t>(per_axis), random, mass);
    for (const NearPoint& p : piece.points)
      if (p.density > over_seen * seen.density) missed += mass_of_point * p.density * seen.volume;
  }
  if (!query.empty) mass.variance += missed;
  return mass;
}

std::string describe_interval(const Subject& s, std::size_t axis, double lo, double hi) {
  const std::string range = describe_range(s.axes, axis, lo, hi);
  if (!s.describe_point) return range;
  Subject::Coordinates middle{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) middle[d] = 0.5;
  middle[axis] = 0.5 * (lo + hi);
  return range + ", for example about " + s.describe_point(middle) + ",";
}

} // namespace mc
