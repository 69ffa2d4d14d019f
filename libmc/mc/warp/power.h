#pragma once
/// Power laws on the unit interval.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Density on [0,1] proportional to x^n.
///   sample : x = u^(1 / (n + 1)). u = 0 is replaced by half a step of u.
///   pdf    : (n + 1) x^n [1/length]; 0 outside.
///   invert : |invert(sample(u)) - u| <= (8 + n / 2) eps. For large n all samples lie close to 1, and x determines u
///            only to n eps.
///   throws : Error unless n is finite and >= 0.
template <Real S> struct Power {
  using Scalar = S;
  using Domain = Interval<S>;

  S n = 1; ///< Exponent.

  Power() = default;
  /// A density with exponent n.
  explicit Power(S n_) : n(n_) {
    using std::isfinite;
    require(isfinite(n) && n >= 0, "Power: exponent {} must be finite and >= 0", static_cast<double>(n));
  }

  Domain domain() const { return {}; }
  S sample(S u) const {
    using std::max, std::pow;
    return S(pow(max(u, S(std::numeric_limits<S>::epsilon() / 4)), S(1 / (n + 1))));
  }
  S pdf(S x) const {
    using std::pow;
    return x >= 0 && x <= 1 ? S((n + 1) * S(pow(x, n))) : S(0);
  }
  S invert(S x) const {
    using std::pow;
    return clamp_to_unit(S(pow(x, S(n + 1))));
  }
  template <Real T> Power<T> cast() const { return Power<T>(T(n)); }
};

} // namespace mc
