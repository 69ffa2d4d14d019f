#pragma once
/// Planar patches as sets of directions from the origin.

#include <mc/core/error.h>
#include <mc/domain/sphere.h>

namespace mc {

namespace detail {
/// Scalar for computations on patches. Float corners are widened to double, so that their digits do not cancel if the
/// origin is close to the plane.
template <Real S> using Wide = std::conditional_t<std::same_as<S, float>, double, S>;
} // namespace detail

/// Directions from the origin to the points origin + s edge1 + t edge2 of a planar patch. The patch is the triangle s,
/// t >= 0, s + t <= 1, or for Corners = 4 the parallelogram s, t in [0, 1].
///   chart    : (s, t) = v for the parallelogram, v0 (1 - v1, v1) for the triangle. Directions are the normalized
///              points.
///   jacobian : Area element * distance of the plane / |p|^3.
///   contains : Unit length, and on the inner side of the planes through the edges up to a distance of 64 eps.
///   error    : The float version computes in double. In double, a patch of 10^k times the height of the origin over
///              its plane costs k digits.
///   throws   : Error unless the triple product of origin, edge1 and edge2 is finite and not 0, so that the patch is
///              not edge-on.
template <Real S, int Corners> struct Patch {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::solid_angle;

  Vec3<S> origin{0, 0, 1}, ///< Corner relative to the viewer.
      edge1{1, 0, 0},      ///< First edge vector.
      edge2{0, 1, 0};      ///< Second edge vector.

  /// A right triangle or square in the plane z = 1.
  Patch() = default;
  /// The patch with this corner and these edges.
  Patch(const Vec3<S>& o, const Vec3<S>& e1, const Vec3<S>& e2) : origin(o), edge1(e1), edge2(e2) {
    using std::abs, std::isfinite;
    const S volume = abs(triple());
    require(volume > 0 && isfinite(volume), "Patch: origin and edges span a volume of {}; it must be finite and > 0",
            static_cast<double>(volume));
  }

  /// Triple product origin . (edge1 x edge2).
  S triple() const { return S(wide(origin).dot(cross<W>(wide(edge1), wide(edge2)))); }
  /// Point of the patch at v of the chart, before normalization.
  Vec3<S> point(const UnitPoint& v) const {
    if constexpr (Corners == 4) return origin + v[0] * edge1 + v[1] * edge2;
    else return origin + v[0] * ((1 - v[1]) * edge1 + v[1] * edge2);
  }
  Point from_unit(const UnitPoint& v) const { return point(v).normalized(); }
  UnitPoint to_unit(const Point& w) const {
    // Cramer's rule for origin + s edge1 + t edge2 = r w.
    const Vec3<W> o = wide(origin), e1 = wide(edge1), e2 = wide(edge2), d = wide(w), n = cross<W>(e1, e2);
    const W along = d.dot(n);
    const W s = d.dot(cross<W>(e2, o)) / along, t = d.dot(cross<W>(o, e1)) / along;
    if constexpr (Corners == 4) return {S(s), S(t)};
    else return {S(s + t), s + t > 0 ? S(t / (s + t)) : S(0)};
  }
  S jacobian(const UnitPoint& v) const {
    using std::abs, std::sqrt;
    const S r2 = point(v).squaredNorm();
    return abs(triple()) / (r2 * S(sqrt(r2))) * (Corners == 4 ? S(1) : v[0]);
  }
  bool contains(const Point& w) const {
    if (!is_unit(w)) return false;
    const Vec3<W> p0 = wide(origin), e1 = wide(edge1), e2 = wide(edge2), p1 = p0 + e1, p2 = p0 + e2, d = wide(w);
    const W sign = triple() > 0 ? W(1) : W(-1), far = p0.norm() + e1.norm() + e2.norm();
    const auto inside = [&](const Vec3<W>& p, const Vec3<W>& edge) {
      const Vec3<W> n = cross<W>(p, edge);
      const W rounding = W(std::numeric_limits<S>::epsilon()) * n.norm() + // + rounding of the corners
                         std::numeric_limits<W>::epsilon() * far * edge.norm();
      return sign * n.dot(d) >= -64 * rounding;
    };
    if constexpr (Corners == 4) return inside(p0, e1) && inside(p1, e2) && inside(p2 + e1, -e1) && inside(p2, -e2);
    else return inside(p0, e1) && inside(p1, e2 - e1) && inside(p2, -e2);
  }
  template <Real T> Patch<T, Corners> cast() const {
    return {cast_point<T>(origin), cast_point<T>(edge1), cast_point<T>(edge2)};
  }

 private:
  using W = detail::Wide<S>;
  static Vec3<W> wide(const Vec3<S>& v) { return cast_point<W>(v); }
};

/// Directions to a triangle.
template <Real S> using TrianglePatch = Patch<S, 3>;
/// Directions to a parallelogram.
template <Real S> using ParallelogramPatch = Patch<S, 4>;

} // namespace mc
