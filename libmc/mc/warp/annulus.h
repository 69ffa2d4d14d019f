#pragma once
/// Uniform points of a ring.

#include <mc/domain/annulus.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform points with inner <= |p| <= outer, in polar coordinates.
///   sample : r^2 = inner^2 + u0 (outer^2 - inner^2), phi = 2 pi u1. With inner = 0 this is the polar map of the disk;
///            it distorts strata near the centre, and UniformDisk does not.
///   pdf    : 1 / (pi (outer - inner) (outer + inner)) [1/area]; 0 outside the ring, up to a tolerance of 4 eps outer.
///   invert : |invert(sample(u)) - u| <= 8 eps outer / (outer - inner). Rounding of p loses digits of u0 on a thin
///            ring.
///   throws : Error unless 0 <= inner < outer, both are finite, and the area passes is_valid_scale.
///   Source : [ShirleyWangZimmerman96].
template <Real S> struct UniformAnnulus {
  using Scalar = S;
  using Domain = Annulus<S>;
  /// The ring, with its radii.

  Domain ring;

  UniformAnnulus() = default;
  /// A ring with the given radii.
  UniformAnnulus(S inner, S outer) : ring(inner, outer) {}

  Domain domain() const { return ring; }
  Vec2<S> sample(const Vec2<S>& u) const { return ring.from_unit(u); }
  S pdf(const Vec2<S>& p) const { return ring.contains(p) ? S(1 / ring.area()) : S(0); }
  Vec2<S> invert(const Vec2<S>& p) const { return clamp_to_unit<S, 2>(ring.to_unit(p)); }
  template <Real T> UniformAnnulus<T> cast() const { return {T(ring.inner), T(ring.outer)}; }
};

} // namespace mc
