#pragma once
/// Orthonormal frames around a direction.

#include <mc/core/types.h>

#include <cmath>

namespace mc {

/// Right-handed orthonormal frame with z along a unit vector.
///   error  : Columns are unit and orthogonal to within 4 eps for any unit z, also at both poles.
///   Source : [DuffEtAl17], the branchless construction with copysign, which has no pole.
template <Real S> struct Frame {
  Vec3<S> x, ///< First axis in world coordinates.
      y,     ///< Second axis.
      z;     ///< Third axis, the normal.

  /// The frame with z = n, for a unit vector n.
  static Frame from_z(const Vec3<S>& n) {
    using std::copysign;
    const S sign = copysign(S(1), n.z());
    const S a = S(-1) / (sign + n.z());
    const S b = n.x() * n.y() * a;
    return {{S(1) + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}, n};
  }

  /// Coordinates of the world vector v in this frame.
  Vec3<S> to_local(const Vec3<S>& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
  /// World coordinates of the vector v of this frame.
  Vec3<S> to_world(const Vec3<S>& v) const { return x * v.x() + y * v.y() + z * v.z(); }
};

} // namespace mc
