#pragma once
/// The unit sphere of directions.

#include <mc/core/turns.h>
#include <mc/domain/concept.h>

namespace mc {

/// Whether |w|^2 = 1 to within 32 eps. False for NaN. Reflection about h multiplies the error of |h|^2 by four.
/// Renderers therefore normalise h, which leaves 3 eps, and not the reflected direction.
template <Real S> bool is_unit(const Vec3<S>& w) {
  using std::abs;
  return abs(w.squaredNorm() - 1) <= 32 * std::numeric_limits<S>::epsilon();
}

/// 1 - |cos(theta)| of a unit vector, without cancellation at the poles.
template <Real S> S one_minus_abs_z(const Vec3<S>& w) {
  using std::abs;
  return (w.x() * w.x() + w.y() * w.y()) / (1 + S(abs(w.z())));
}

/// 1 - cos(theta) of a unit vector, without cancellation at the +z pole.
template <Real S> S one_minus_z(const Vec3<S>& w) { return choose<S>(w.z() > 0, one_minus_abs_z(w), S(1 - w.z())); }

/// Unit vectors.
///   chart : v = ((1 - z) / 2, phi / 2 pi), uniform in solid angle. The Jacobian is the constant 4 pi.
///   error : v keeps its relative precision at the +z pole. 1 - v keeps its relative precision at the -z pole if S is
///           finer than the type to which the direction was rounded.
template <Real S> struct Sphere {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::solid_angle;

  Point from_unit(const UnitPoint& v) const {
    return polar_direction<S>(2 * safe_sqrt<S>(v[0] * (1 - v[0])), 1 - 2 * v[0], v[1]);
  }
  UnitPoint to_unit(const Point& w) const {
    const S near = one_minus_abs_z(w) / 2;
    return {choose<S>(w.z() > 0, near, S(1 - near)), azimuth_turns<S>(w.x(), w.y())};
  }
  S jacobian(const UnitPoint&) const { return 4 * pi<S>; }
  bool contains(const Point& w) const { return is_unit(w); }
  template <Real T> Sphere<T> cast() const { return {}; }
};

} // namespace mc
