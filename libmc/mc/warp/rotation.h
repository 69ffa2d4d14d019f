#pragma once
/// Uniform rotations.

#include <mc/domain/unit_quaternions.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform rotations as unit quaternions (x, y, z, w).
///   sample : the chart of UnitQuaternions.
///   pdf    : 1 / pi^2, per volume on the unit sphere of four dimensions with q and -q as one rotation.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : [Shoemake92].
template <Real S> struct UniformRotation {
  using Scalar = S;
  using Domain = UnitQuaternions<S>;

  Domain domain() const { return {}; }
  Vec<S, 4> sample(const Vec3<S>& u) const { return domain().from_unit(u); }
  S pdf(const Vec<S, 4>&) const { return 1 / (pi<S> * pi<S>); }
  Vec3<S> invert(const Vec<S, 4>& q) const { return clamp_to_unit<S, 3>(domain().to_unit(q)); }
  template <Real T> UniformRotation<T> cast() const { return {}; }
};

} // namespace mc
