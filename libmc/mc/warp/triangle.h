#pragma once
/// Uniform points of a triangle.

#include <mc/domain/triangle.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform barycentric coordinates (b0, b1). Folds the square along its diagonal without tearing it: neighbours in u
/// stay neighbours in the triangle, so strata stay compact.
///   sample : (u0 / 2, u1 - u0 / 2) if u0 < u1, else (u0 - u1 / 2, u1 / 2).
///   pdf    : 2 [1/area of the barycentric triangle]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 4 eps.
///   Source : [Heitz19].
template <Real S> struct UniformTriangle {
  using Scalar = S;
  using Domain = Triangle<S>;

  Domain domain() const { return {}; }
  Vec2<S> sample(const Vec2<S>& u) const {
    const bool low = u[0] < u[1];
    const S half = S((low ? u[0] : u[1]) / 2); // two selections, no branch
    return {low ? half : S(u[0] - half), low ? S(u[1] - half) : half};
  }
  S pdf(const Vec2<S>& b) const { return domain().contains(b) ? S(2) : S(0); }
  Vec2<S> invert(const Vec2<S>& b) const {
    return clamp_to_unit(b[0] < b[1] ? Vec2<S>(2 * b[0], b[1] + b[0]) : Vec2<S>(b[0] + b[1], 2 * b[1]));
  }
  template <Real T> UniformTriangle<T> cast() const { return {}; }
};

} // namespace mc
