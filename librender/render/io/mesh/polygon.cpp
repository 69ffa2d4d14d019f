#include <render/io/mesh/polygon.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace render {

namespace {

using Point = mc::Vec2<double>;
using Triangle = std::array<std::uint32_t, 3>;

// Twice the signed area of a triangle; > 0 for counter-clockwise corners.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// A polygon projected to its plane, scaled to size 1, counter-clockwise.
struct Flat {
  std::vector<Point> points;
  double area2 = 0; // twice the area of the polygon
};

// Projects along the coordinate axis nearest to the normal, which preserves containment. nullopt for a polygon without
// area.
std::optional<Flat> flattened(std::span<const Vec3d> corners) {
  double size = 0;
  for (const Vec3d& p : corners) size = std::max(size, (p - corners[0]).lpNorm<Eigen::Infinity>());
  if (!(size > 0 && std::isfinite(size))) return {};
  const auto corner = [&](std::size_t i) -> Vec3d { return (corners[i] - corners[0]) / size; };
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) normal += mc::cross<double>(corner(i - 1), corner(i));
  int axis = 0;
  if (!(normal.cwiseAbs().maxCoeff(&axis) > 0)) return {};
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  Flat flat{{}, std::abs(normal[axis])};
  flat.points.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) flat.points.emplace_back(corner(i)[x], corner(i)[y]);
  return flat;
}

// Whether all triangles of the fan about corner 0 are counter-clockwise. Then they do not overlap.
bool sees_all(const std::vector<Point>& p) {
  for (std::size_t i = 2; i < p.size(); ++i)
    if (!(turn(p[0], p[i - 1], p[i]) >= 0)) return false;
  return true;
}

// The remaining corners in a circular list.
class Ring {
 public:
  explicit Ring(const Flat& flat) : points_(flat.points), negligible_(1e-12 * flat.area2) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
  }

  std::uint32_t next(std::uint32_t i) const { return next_[i]; }
  Triangle triangle(std::uint32_t i) const { return {previous_[i], i, next_[i]}; }
  bool turns_left(std::uint32_t i) const { return turn_at(i) > 0; }
  bool is_flat(std::uint32_t i) const { return std::abs(turn_at(i)) <= negligible_; }
  // Whether the edge after the corner goes back along the edge before it. Inside and outside cannot be distinguished
  // beyond such a corner.
  bool is_spike(std::uint32_t i) const {
    const Point back = points_[previous_[i]] - points_[i], on = points_[next_[i]] - points_[i];
    return is_flat(i) && back.dot(on) > 0;
  }

  // Whether the triangle at corner i contains no other remaining corner. It suffices to test corners that do not turn
  // left.
  bool is_ear(std::uint32_t i) const {
    const auto [a, b, c] = triangle(i);
    for (std::uint32_t j = next_[c]; j != a; j = next_[j])
      if (holds(i, points_[j]) && !turns_left(j)) return false;
    return true;
  }

  void remove(std::uint32_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
  }

 private:
  double turn_at(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }
  // Whether triangle i contains p. Edges count, corners do not: where a slit begins, two corners coincide.
  bool holds(std::uint32_t i, const Point& p) const {
    const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 && p != a && p != b && p != c;
  }

  const std::vector<Point>& points_;
  double negligible_;
  std::vector<std::uint32_t> next_, previous_;
};

// The first remaining corner, from `from` on, that can be removed: a spike, else an ear, else a corner without area.
// For a self-intersecting polygon any corner.
std::uint32_t ear_from(const Ring& ring, std::uint32_t from, std::size_t left) {
  const auto find = [&](const auto& is_wanted) -> std::optional<std::uint32_t> {
    std::uint32_t i = from;
    for (std::size_t k = 0; k < left; ++k) {
      if (is_wanted(i)) return i;
      i = ring.next(i);
    }
    return {};
  };
  if (const auto spike = find([&](std::uint32_t i) { return ring.is_spike(i); })) return *spike;
  if (const auto ear = find([&](std::uint32_t i) { return ring.turns_left(i) && ring.is_ear(i); })) return *ear;
  return find([&](std::uint32_t i) { return ring.is_flat(i); }).value_or(from);
}

} // namespace

std::vector<Triangle> triangulate_polygon(std::span<const Vec3d> corners) {
  std::vector<Triangle> triangles;
  triangles.reserve(corners.size() - 2);
  const std::optional<Flat> flat = corners.size() > 3 ? flattened(corners) : std::nullopt;
  if (!flat || sees_all(flat->points)) {
    for (std::uint32_t i = 2; i < corners.size(); ++i) triangles.push_back({0, i - 1, i});
    return triangles;
  }
  Ring ring(*flat);
  std::uint32_t at = 0;
  for (std::size_t left = corners.size(); left >= 3; --left) {
    const std::uint32_t ear = ear_from(ring, at, left);
    triangles.push_back(ring.triangle(ear));
    ring.remove(ear);
    at = ring.next(ring.next(ear));
  }
  return triangles;
}

void append_triangulated(const std::vector<Vec3d>& positions, std::span<const std::uint32_t> polygon,
                         std::vector<Triangle>& triangles) {
  if (polygon.size() == 3) { // the most common case
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  std::vector<Vec3d> corners;
  corners.reserve(polygon.size());
  for (const std::uint32_t i : polygon) corners.push_back(positions[i]);
  for (const auto& [a, b, c] : triangulate_polygon(corners)) triangles.push_back({polygon[a], polygon[b], polygon[c]});
}

} // namespace render
