#pragma once
/// The tent distribution.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

namespace mc {

/// Density that falls linearly from the centre to 0 at distance radius.
///   sample : x = center - radius (1 - sqrt(2 u)) for u < 1/2, mirrored for u > 1/2.
///   pdf    : (radius - |x - center|) / radius^2 [1/length]; 0 outside. Inside, at least the density at half a step of
///            u from the end: samples that round to the end keep a positive density.
///   invert : |invert(sample(u)) - u| <= 8 eps for center = 0. A centre far from 0 adds the rounding of x.
///   throws : Error unless center is finite and radius passes is_valid_scale.
template <Real S> struct Tent {
  using Scalar = S;
  using Domain = Interval<S>;

  S center = 0,   ///< Centre.
      radius = 1; ///< Distance from the centre to the ends.

  Tent() = default;
  /// A tent about `center` with the given radius.
  Tent(S center_, S radius_) : center(center_), radius(radius_) {
    using std::isfinite;
    require(
        isfinite(center) && is_valid_scale(radius, center),
        "Tent: center {}, radius {}: both must be finite, radius > 0 and neither denormal, next to the largest number "
        "nor below 8 eps |center|",
        static_cast<double>(center), static_cast<double>(radius));
  }

  Domain domain() const { return {center - radius, center + radius}; }
  S sample(S u) const {
    using std::copysign, std::min, std::sqrt;
    // The distance from the near end is radius sqrt(2 u). It does not cancel.
    const S r = radius * (1 - S(sqrt(S(2 * min(u, S(1 - u))))));
    // copysign instead of a branch on random u, which no processor predicts
    return center + S(copysign(r, S(u - S(0.5))));
  }
  S pdf(S x) const {
    using std::abs, std::max;
    if (!domain().contains(x)) return S(0);
    const S distance = abs(S(x - center));
    return max(S((radius - distance) / radius), S(std::numeric_limits<S>::epsilon() / 4)) / radius;
  }
  S invert(S x) const {
    using std::abs;
    const S t = 1 - S(abs(S(x - center))) / radius, tail = t * t / 2;
    return clamp_to_unit(x < center ? tail : S(1 - tail));
  }
  template <Real T> Tent<T> cast() const { return {T(center), T(radius)}; }
};

} // namespace mc
