#pragma once
/// Uniform points of a parallelogram.

#include <mc/domain/parallelogram.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform points of a parallelogram in space.
///   sample : origin + u0 a + u1 b.
///   pdf    : 1 / |a x b| [1/area]; 0 off the parallelogram, up to the rounding of a sample.
///   invert : |invert(sample(u)) - u| <= 16 eps for an origin at 0 and edges at a wide angle. A distant origin or a
///            narrow angle adds its own conditioning.
///   throws : Error unless the coordinates are finite and area^2 passes is_valid_scale.
template <Real S> struct UniformParallelogram {
  using Scalar = S;
  using Domain = Parallelogram<S>;

  /// The parallelogram: origin and edges a, b.
  Domain shape;

  Domain domain() const { return shape; }
  Vec3<S> sample(const Vec2<S>& u) const { return shape.from_unit(u); }
  S pdf(const Vec3<S>& x) const { return shape.contains(x) ? S(1 / shape.area()) : S(0); }
  Vec2<S> invert(const Vec3<S>& x) const { return clamp_to_unit<S, 2>(shape.to_unit(x)); }
  template <Real T> UniformParallelogram<T> cast() const { return {shape.template cast<T>()}; }
};

} // namespace mc
