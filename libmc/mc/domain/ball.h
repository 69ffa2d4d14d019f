#pragma once
/// The unit ball.

#include <mc/domain/sphere.h>

namespace mc {

/// Points of space with |p| <= 1.
///   chart : v = (r^3, (1 - cos(theta)) / 2, phi / 2 pi), uniform in volume. The Jacobian is the constant 4 pi / 3.
///   error : The azimuth keeps its relative precision at any radius, and so does the polar angle near the +z axis.
template <Real S> struct Ball {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec3<S>;
  static constexpr int dim = 3;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::volume;

  Point from_unit(const UnitPoint& v) const {
    using std::cbrt;
    return S(cbrt(v[0])) * Sphere<S>{}.from_unit(Vec2<S>(v[1], v[2]));
  }
  UnitPoint to_unit(const Point& p) const {
    const S r = p.norm();
    const Vec2<S> direction = r > 0 ? Sphere<S>{}.to_unit(p / r) : Vec2<S>(0, 0);
    return {r * r * r, direction[0], direction[1]};
  }
  S jacobian(const UnitPoint&) const { return 4 * pi<S> / 3; }
  bool contains(const Point& p) const { return p.squaredNorm() <= 1 + 8 * std::numeric_limits<S>::epsilon(); }
  template <Real T> Ball<T> cast() const { return {}; }
};

} // namespace mc
