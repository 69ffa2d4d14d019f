#pragma once
/// The upper unit hemisphere.

#include <mc/core/turns.h>
#include <mc/domain/sphere.h>

namespace mc {

/// Unit vectors with z >= 0.
///   chart : v = (1 - z, phi / 2 pi), uniform in solid angle. The Jacobian is the constant 2 pi.
///   error : v keeps its relative precision at the pole, where 1 - z is computed from x^2 + y^2.
template <Real S> struct Hemisphere {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::solid_angle;

  Point from_unit(const UnitPoint& v) const {
    return polar_direction<S>(safe_sqrt<S>(v[0] * (2 - v[0])), 1 - v[0], v[1]);
  }
  UnitPoint to_unit(const Point& w) const { return {one_minus_z(w), azimuth_turns<S>(w.x(), w.y())}; }
  S jacobian(const UnitPoint&) const { return 2 * pi<S>; }
  bool contains(const Point& w) const { return w.z() >= 0 && is_unit(w); }
  template <Real T> Hemisphere<T> cast() const { return {}; }
};

} // namespace mc
