#pragma once
/// Planar patches seen from the origin, as sets of directions.

#include <mc/core/error.h>
#include <mc/domain/sphere.h>

namespace mc {

/// Directions through the planar triangle (origin + s edge1 + t edge2; s, t >= 0, s + t <= 1), or with Corners = 4
/// through the whole parallelogram (s, t <= 1).
///   chart    : (s, t) = v for the parallelogram, v0 (1 - v1, v1) for the triangle; directions are normalized points
///   jacobian : area element * distance of the plane / |p|^3
///   contains : unit, and on the inner side of the planes through the edges up to 64 eps of distance
///   throws   : Error unless the triple product of origin, edge1, edge2 is finite and not 0: the patch must not be seen
///              edge-on
template <Real S, int Corners> struct Patch {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  static constexpr Measure measure = Measure::solid_angle;

  Vec3<S> origin{0, 0, 1}, edge1{1, 0, 0}, edge2{0, 1, 0};

  Patch() = default;
  Patch(const Vec3<S>& o, const Vec3<S>& e1, const Vec3<S>& e2) : origin(o), edge1(e1), edge2(e2) {
    using std::abs, std::isfinite;
    const S volume = abs(triple());
    require(volume > 0 && isfinite(volume), "Patch: origin and edges span a volume of {}; it must be finite and > 0",
            static_cast<double>(volume));
  }

  S triple() const { return origin.dot(cross<S>(edge1, edge2)); }
  Vec3<S> point(const UnitPoint& v) const {
    if constexpr (Corners == 4) return origin + v[0] * edge1 + v[1] * edge2;
    else return origin + v[0] * ((1 - v[1]) * edge1 + v[1] * edge2);
  }
  Point from_unit(const UnitPoint& v) const { return point(v).normalized(); }
  UnitPoint to_unit(const Point& w) const {
    // Cramer's rule for origin + s edge1 + t edge2 = r w, after subtracting the origin's own direction.
    const Vec3<S> n = cross<S>(edge1, edge2);
    const S distance = origin.dot(n), along = w.dot(n);
    const Vec3<S> off = w * (distance / along) - origin;
    const S n2 = n.squaredNorm();
    const S s = n.dot(cross<S>(off, edge2)) / n2, t = n.dot(cross<S>(edge1, off)) / n2;
    if constexpr (Corners == 4) return {s, t};
    else return {s + t, s + t > 0 ? S(t / (s + t)) : S(0)};
  }
  S jacobian(const UnitPoint& v) const {
    using std::abs, std::sqrt;
    const S r2 = point(v).squaredNorm();
    return abs(triple()) / (r2 * S(sqrt(r2))) * (Corners == 4 ? S(1) : v[0]);
  }
  bool contains(const Point& w) const {
    if (!is_unit(w)) return false;
    const Vec3<S> p1 = origin + edge1, p2 = origin + edge2;
    const S sign = triple() > 0 ? S(1) : S(-1);
    if constexpr (Corners == 4)
      return inside(origin, edge1, w, sign) && inside(p1, edge2, w, sign) && inside(p2 + edge1, -edge1, w, sign) &&
             inside(p2, -edge2, w, sign);
    else return inside(origin, edge1, w, sign) && inside(p1, edge2 - edge1, w, sign) && inside(p2, -edge2, w, sign);
  }
  template <Real T> Patch<T, Corners> cast() const {
    return {cast_point<T>(origin), cast_point<T>(edge1), cast_point<T>(edge2)};
  }

 private:
  static bool inside(const Vec3<S>& p, const Vec3<S>& edge, const Vec3<S>& w, S sign) {
    const Vec3<S> n = cross<S>(p, edge);
    return sign * n.dot(w) >= -64 * std::numeric_limits<S>::epsilon() * n.norm();
  }
};

template <Real S> using TrianglePatch = Patch<S, 3>;
template <Real S> using ParallelogramPatch = Patch<S, 4>;

} // namespace mc
