#pragma once
/// Uniform points of the unit ball.

#include <mc/domain/ball.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Uniform points with |p| <= 1.
///   sample : r = cbrt(u0), z = r (1 - 2 u1), phi = 2 pi u2.
///   pdf    : 3 / (4 pi) [1/volume]; 0 for |p| > 1.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : inverse CDF of r; the direction as in [ShirleyWangZimmerman96].
template <Real S> struct UniformBall {
  using Scalar = S;
  using Domain = Ball<S>;

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec3<S>& u) const { return domain().from_unit(u); }
  S pdf(const Vec3<S>& p) const { return domain().contains(p) ? S(3 / (4 * pi<S>)) : S(0); }
  Vec3<S> invert(const Vec3<S>& p) const { return domain().to_unit(p).cwiseMin(one_minus_epsilon<S>); }
  template <Real T> UniformBall<T> cast() const { return {}; }
};

} // namespace mc
