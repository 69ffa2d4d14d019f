#pragma once
/// Rotations as unit quaternions.

#include <mc/core/turns.h>
#include <mc/domain/concept.h>

namespace mc {

/// Unit quaternions (x, y, z, w) with scalar part w; q and -q are the same rotation.
///   chart   : v = (z^2 + w^2, azimuth of (w, z) / pi, azimuth of (y, x) / 2 pi) of the one of q and -q with z > 0, or
///             z = 0 and w > 0. Uniform in volume; the Jacobian is the constant pi^2.
///   measure : volume on the unit sphere of four dimensions, of which the rotations take one half: the density of
///             uniform rotations is 1 / pi^2. A density f of the uniform (Haar) probability measure is f / pi^2 here.
///   Source  : [Shoemake92].
template <Real S> struct UnitQuaternions {
  using Scalar = S;
  using Point = Vec<S, 4>;
  using UnitPoint = Vec3<S>;
  static constexpr int dim = 3;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::volume;

  Point from_unit(const UnitPoint& v) const {
    const Vec2<S> xy = polar_point<S>(safe_sqrt<S>(1 - v[0]), v[2]), wz = polar_point<S>(safe_sqrt(v[0]), v[1] / 2);
    return {xy[1], xy[0], wz[1], wz[0]};
  }
  UnitPoint to_unit(const Point& q) const {
    const S sign = q[2] < 0 || (q[2] == 0 && q[3] < 0) ? S(-1) : S(1);
    return {q[2] * q[2] + q[3] * q[3], 2 * azimuth_turns<S>(sign * q[3], sign * q[2]),
            azimuth_turns<S>(sign * q[1], sign * q[0])};
  }
  S jacobian(const UnitPoint&) const { return pi<S> * pi<S>; }
  bool contains(const Point& q) const {
    using std::abs;
    return abs(q.squaredNorm() - 1) <= 32 * std::numeric_limits<S>::epsilon();
  }
  template <Real T> UnitQuaternions<T> cast() const { return {}; }
};

} // namespace mc
