#pragma once
/// Barycentric coordinates of a triangle.

#include <mc/domain/concept.h>

namespace mc {

/// Weights (b0, b1) of the first two vertices: b0 >= 0, b1 >= 0, b0 + b1 <= 1. This is a right triangle of area 1/2. A
/// density per world area is the density here divided by twice the area of the world triangle.
///   chart : b0 = 1 - sqrt(1 - v0), b1 = (1 - b0) v1, uniform in area. The Jacobian is the constant 1/2.
template <Real S> struct Triangle {
  using Scalar = S;
  using Point = Vec2<S>;
  using UnitPoint = Vec2<S>;
  static constexpr int dim = 2;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::area;

  Point from_unit(const UnitPoint& v) const {
    using std::sqrt;
    const S root = sqrt(S(1 - v[0]));
    return {v[0] / (1 + root), root * v[1]};
  }
  UnitPoint to_unit(const Point& b) const {
    const S rest = 1 - b[0];
    return {b[0] * (2 - b[0]), rest > 0 ? S(b[1] / rest) : S(0)};
  }
  S jacobian(const UnitPoint&) const { return S(0.5); }
  bool contains(const Point& b) const {
    return b[0] >= 0 && b[1] >= 0 && b[0] + b[1] <= 1 + 2 * std::numeric_limits<S>::epsilon();
  }
  template <Real T> Triangle<T> cast() const { return {}; }
};

} // namespace mc
