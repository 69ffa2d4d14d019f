#pragma once
/// Parallelograms in space.

#include <mc/core/error.h>
#include <mc/domain/concept.h>

#include <algorithm>

namespace mc {

/// Points origin + v0 a + v1 b of R^3, v in [0,1]^2.
///   chart  : v. The Jacobian is the area |a x b|.
///   throws : Error unless all coordinates are finite and the squared area passes is_valid_scale().
template <Real S> struct Parallelogram {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::area;

  Point origin = Point::Zero(), ///< Corner.
      a = Point::UnitX(),       ///< First edge vector.
      b = Point::UnitY();       ///< Second edge vector.

  /// The unit square in the plane z = 0.
  Parallelogram() = default;
  /// The parallelogram with this corner and these edges.
  Parallelogram(const Point& origin_, const Point& a_, const Point& b_) : origin(origin_), a(a_), b(b_) {
    using std::isfinite;
    for (int i = 0; i < 3; ++i)
      require(isfinite(origin[i]) && isfinite(a[i]) && isfinite(b[i]),
              "Parallelogram: coordinate {} of the origin or of an edge is not finite: {}, {}, {}", i,
              static_cast<double>(origin[i]), static_cast<double>(a[i]), static_cast<double>(b[i]));
    require(
        is_valid_scale(S(sqr<S>(area()))),
        "Parallelogram: the edges span an area of {}; it must be finite and > 0, its square neither denormal nor next "
        "to the largest number",
        static_cast<double>(area()));
  }

  /// Area.
  S area() const { return cross<S>(a, b).norm(); }
  Point from_unit(const UnitPoint& v) const { return origin + v[0] * a + v[1] * b; }
  UnitPoint to_unit(const Point& x) const {
    using std::max, std::min;
    const Vec3<S> n = cross<S>(a, b), d = x - origin, unit = n / n.norm();
    const S v0 = cross<S>(d, b).dot(unit) / n.norm(), v1 = cross<S>(a, d).dot(unit) / n.norm();
    return {min(max(v0, S(0)), S(1)), min(max(v1, S(0)), S(1))};
  }
  S jacobian(const UnitPoint&) const { return area(); }
  /// Whether x lies in the plane and within the edges, up to the rounding of a sample.
  bool contains(const Point& x) const {
    return (from_unit(to_unit(x)) - x).norm() <=
           16 * std::numeric_limits<S>::epsilon() * (origin.norm() + a.norm() + b.norm());
  }
  template <Real T> Parallelogram<T> cast() const {
    return {cast_point<T>(origin), cast_point<T>(a), cast_point<T>(b)};
  }
};

} // namespace mc
