#pragma once
/// Spherical caps.

#include <mc/core/error.h>
#include <mc/core/turns.h>
#include <mc/domain/sphere.h>

namespace mc {

/// Unit vectors within an angle of +z. h = 1 - cos(angle) in [1e-37, 2] keeps the precision of any angle from 5e-19 rad
/// to pi.
///   chart  : v = ((1 - z) / h, phi / 2 pi), uniform in solid angle. The Jacobian is the constant 2 pi h.
///   throws : Error unless 1e-37 <= h <= 2.
template <Real S> struct Cap {
  using Scalar = S;
  using Point = Vec3<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::solid_angle;

  S h = 1; ///< 1 - cos(angle).

  /// The upper hemisphere.
  Cap() = default;
  /// The cap with h = 1 - cos(angle).
  explicit Cap(S h_) : h(h_) {
    require(h >= S(1e-37) && h <= 2, "Cap: 1 - cos = {} must lie in (0, 2], and not below 1e-37",
            static_cast<double>(h));
  }

  Point from_unit(const UnitPoint& v) const {
    const S t = v[0] * h; // 1 - z: then sin^2 = t (2 - t) does not cancel
    return polar_direction<S>(safe_sqrt<S>(t * (2 - t)), 1 - t, v[1]);
  }
  UnitPoint to_unit(const Point& w) const { return {one_minus_z(w) / h, azimuth_turns<S>(w.x(), w.y())}; }
  S jacobian(const UnitPoint&) const { return 2 * pi<S> * h; }
  /// Whether the direction of w lies in the cone, up to rounding. Does not check the length.
  bool contains_direction(const Point& w) const {
    return one_minus_z(w) <= h * (1 + 8 * std::numeric_limits<S>::epsilon());
  }
  bool contains(const Point& w) const { return is_unit(w) && contains_direction(w); }
  template <Real T> Cap<T> cast() const { return Cap<T>(T(h)); }
};

} // namespace mc
