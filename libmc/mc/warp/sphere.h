#pragma once
/// Uniform directions on the whole sphere.

#include <mc/domain/sphere.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform directions on the sphere.
///   sample : z = 1 - 2 u0, phi = 2 pi u1.
///   pdf    : 1 / (4 pi) [1/sr].
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   Source : [ShirleyWangZimmerman96].
template <Real S> struct UniformSphere {
  using Scalar = S;
  using Domain = Sphere<S>;

  Domain domain() const { return {}; }
  Vec3<S> sample(const Vec2<S>& u) const { return domain().from_unit(u); }
  S pdf(const Vec3<S>&) const { return 1 / (4 * pi<S>); }
  Vec2<S> invert(const Vec3<S>& w) const { return clamp_to_unit<S, 2>(domain().to_unit(w)); }
  template <Real T> UniformSphere<T> cast() const { return {}; }
};

} // namespace mc
