#pragma once
/// Intervals of the real line: finite, half-infinite and infinite.

#include <mc/core/error.h>
#include <mc/domain/concept.h>

#include <algorithm>

namespace mc {

/// The finite interval [lo, hi].
///   chart  : v = (x - lo) / (hi - lo). The Jacobian is hi - lo. Rounding never carries a point out of the interval.
///   throws : Error unless lo < hi, and lo, hi and hi - lo are finite.
template <Real S> struct Interval {
  using Scalar = S;
  using Point = S;
  using UnitPoint = S;
  static constexpr int dim = 1;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::length;

  S lo = 0,   ///< Lower bound.
      hi = 1; ///< Upper bound.

  /// The unit interval.
  Interval() = default;
  /// The interval [lo_, hi_].
  Interval(S lo_, S hi_) : lo(lo_), hi(hi_) {
    using std::isfinite;
    require(isfinite(lo) && isfinite(hi) && lo < hi && isfinite(S(hi - lo)),
            "Interval: [{}, {}] needs finite bounds and a finite width, with lo < hi", static_cast<double>(lo),
            static_cast<double>(hi));
  }

  S from_unit(S v) const {
    const S x = lo * (1 - v) + hi * v;
    return std::clamp(x, lo, hi);
  }
  S to_unit(S x) const { return (x - lo) / (hi - lo); }
  S jacobian(S) const { return hi - lo; }
  bool contains(S x) const { return x >= lo && x <= hi; }
  template <Real T> Interval<T> cast() const { return {T(lo), T(hi)}; }
};

/// The half line [origin, inf), or (-inf, origin] for negative scale.
///   chart  : x = origin + scale v / (1 - v).
///   throws : Error unless origin is finite and scale is finite and not 0.
template <Real S> struct HalfLine {
  using Scalar = S;
  using Point = S;
  using UnitPoint = S;
  static constexpr int dim = 1;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::length;

  S origin = 0,  ///< End point.
      scale = 1; ///< Distance of the image of v = 1/2 from the end point, with sign.

  /// The positive half line.
  HalfLine() = default;
  /// The half line from origin_ in the direction of the sign of scale_.
  HalfLine(S origin_, S scale_) : origin(origin_), scale(scale_) {
    using std::isfinite;
    require(isfinite(origin) && isfinite(scale) && scale != 0,
            "HalfLine: origin {}, scale {}: both must be finite and scale not 0", static_cast<double>(origin),
            static_cast<double>(scale));
  }

  S from_unit(S v) const { return origin + scale * (v / (1 - v)); }
  S to_unit(S x) const {
    const S t = (x - origin) / scale;
    return t / (1 + t);
  }
  S jacobian(S v) const {
    using std::abs;
    return S(abs(scale)) / sqr<S>(1 - v);
  }
  bool contains(S x) const {
    using std::isfinite;
    return isfinite(x) && (x - origin) / scale >= 0;
  }
  template <Real T> HalfLine<T> cast() const { return {T(origin), T(scale)}; }
};

/// The real line.
///   chart  : x = center + 2 scale w / (1 - w^2) with w = 2 v - 1. Most of the cube maps to within 2 scale of the
///            center.
///   throws : Error unless center is finite and scale is finite and > 0.
template <Real S> struct RealLine {
  using Scalar = S;
  using Point = S;
  using UnitPoint = S;
  static constexpr int dim = 1;
  /// Measure of densities on the domain.
  static constexpr Measure measure = Measure::length;

  S center = 0,  ///< Image of v = 1/2.
      scale = 1; ///< Width of the chart about the center.

  /// The real line with center 0 and scale 1.
  RealLine() = default;
  /// The real line with this chart.
  RealLine(S center_, S scale_) : center(center_), scale(scale_) {
    using std::isfinite;
    require(isfinite(center) && isfinite(scale) && scale > 0,
            "RealLine: center {}, scale {}: both must be finite and scale > 0", static_cast<double>(center),
            static_cast<double>(scale));
  }

  S from_unit(S v) const { return center + scale * ((2 * v - 1) / (2 * v * (1 - v))); }
  S to_unit(S x) const {
    using std::sqrt;
    const S t = (x - center) / scale;
    // v = (1 + t / (1 + root)) / 2. For t < 0, root + t = 1 / (root - t) does not cancel.
    const S root = sqrt(S(1 + t * t));
    return (1 + (t < 0 ? S(1 / (root - t)) : S(root + t))) / (2 * (1 + root));
  }
  S jacobian(S v) const { return scale * ((1 - 2 * v * (1 - v)) / (2 * sqr<S>(v * (1 - v)))); }
  bool contains(S x) const {
    using std::isfinite;
    return isfinite(x);
  }
  template <Real T> RealLine<T> cast() const { return {T(center), T(scale)}; }
};

} // namespace mc
