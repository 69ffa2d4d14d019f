#pragma once
/// Uniform distributions on intervals and boxes.

#include <mc/core/error.h>
#include <mc/domain/box.h>
#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

namespace mc {

/// Uniform numbers of [lo, hi].
///   sample : x = lo + u (hi - lo), never above hi.
///   pdf    : 1 / (hi - lo) [1/length]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 4 eps max(|lo|, |hi|) / (hi - lo). The rounding of x causes this bound.
///   throws : Error unless lo < hi, both are finite, and hi - lo passes is_valid_scale.
template <Real S> struct UniformInterval {
  using Scalar = S;
  using Domain = Interval<S>;

  /// The interval.
  Domain interval;

  UniformInterval() = default;
  /// An interval with the given ends.
  UniformInterval(S lo, S hi) : interval(lo, hi) {
    require(is_valid_scale(S(hi - lo)),
            "UniformInterval: [{}, {}] has a width that is denormal or next to the largest number",
            static_cast<double>(lo), static_cast<double>(hi));
  }

  Domain domain() const { return interval; }
  S sample(S u) const { return interval.lo + u * (interval.hi - interval.lo); }
  S pdf(S x) const { return interval.contains(x) ? S(1 / interval.jacobian(x)) : S(0); }
  S invert(S x) const { return clamp_to_unit<S>(interval.to_unit(x)); }
  template <Real T> UniformInterval<T> cast() const { return {T(interval.lo), T(interval.hi)}; }
};

/// Uniform points of an axis-aligned box. Coordinate i of u varies coordinate i of the point.
///   sample : x = lo + u (hi - lo), never above hi.
///   pdf    : 1 / volume [1/area, 1/volume]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 4 eps max(|lo|, |hi|) / (hi - lo) in each coordinate.
///   throws : Error unless lo < hi and both are finite in each coordinate, and hi - lo and the volume pass
///            is_valid_scale.
template <Real S, int N> struct UniformBox {
  using Scalar = S;
  using Domain = Box<S, N>;
  using Point = Vec<S, N>;

  /// The box.
  Domain box;

  UniformBox() = default;
  /// A box with the given corners.
  UniformBox(const Point& lo, const Point& hi) : box(lo, hi) {
    for (Eigen::Index i = 0; i < lo.size(); ++i)
      require(is_valid_scale(S(hi[i] - lo[i])), "UniformBox: side {} is denormal or next to the largest number",
              static_cast<double>(hi[i] - lo[i]));
    require(is_valid_scale(box.jacobian(lo)), "UniformBox: the volume {} is denormal or next to the largest number",
            static_cast<double>(box.jacobian(lo)));
  }

  Domain domain() const { return box; }
  Point sample(const Point& u) const { return box.lo + u.cwiseProduct(box.hi - box.lo); }
  S pdf(const Point& x) const { return box.contains(x) ? S(1 / box.jacobian(x)) : S(0); }
  Point invert(const Point& x) const { return clamp_to_unit<S, N>(box.to_unit(x)); }
  template <Real T> UniformBox<T, N> cast() const { return {cast_point<T>(box.lo), cast_point<T>(box.hi)}; }
};

} // namespace mc
