#pragma once
/// Exponential distributions on the half line and on an interval.

#include <mc/core/log.h>
#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Exponential distribution on [0, inf).
///   sample : x = -log(1 - u) / rate.
///   pdf    : rate exp(-rate x) [1/length]; 0 for x < 0. Relative error (2 + rate x) eps: the tail is ill-conditioned
///            in x.
///   invert : |invert(sample(u)) - u| <= 8 eps.
///   throws : Error unless rate > 0 and 1 / rate passes is_valid_scale.
template <Real S> struct Exponential {
  using Scalar = S;
  using Domain = HalfLine<S>;

  S rate = 1; ///< Rate of decay [1/length].

  Exponential() = default;
  /// An exponential distribution with the given rate.
  explicit Exponential(S rate_) : rate(rate_) {
    require(
        rate > 0 && is_valid_scale(S(1 / rate)),
        "Exponential: rate {} and its inverse must be finite and > 0, neither denormal nor next to the largest number",
        static_cast<double>(rate));
  }

  Domain domain() const { return {S(0), S(1 / rate)}; }
  S sample(S u) const { return -log_of_complement(u) / rate; }
  S pdf(S x) const {
    using std::exp;
    return x >= 0 ? S(rate * S(exp(S(-rate * x)))) : S(0);
  }
  S invert(S x) const {
    using std::expm1;
    return clamp_to_unit<S>(-S(expm1(S(-rate * x))));
  }
  template <Real T> Exponential<T> cast() const { return Exponential<T>(T(rate)); }
};

/// Exponential distribution cut to [0, length]: decays for rate > 0, grows for rate < 0, uniform for rate = 0.
///   sample : x = -log(1 - u (1 - e^-k)) / |rate| with k = |rate| length; mirrored for rate < 0. For k > 1 and u > 1/2
///            the argument of the logarithm is computed as (1 - u) + u e^-k, which does not cancel.
///   pdf    : |rate| exp(-|rate| t) / (1 - e^-k) [1/length] at distance t from the dense end; 0 outside.
///   invert : |invert(sample(u)) - u| <= 16 eps for rate >= 0, and max(16, k) eps for rate < 0: there the dense end is
///            not at 0.
///   throws : Error unless rate and k are finite and length passes is_valid_scale. Unless k vanishes, 1 / |rate| must
///            pass it too.
template <Real S> struct TrimmedExponential {
  using Scalar = S;
  using Domain = Interval<S>;

  S rate = 1,     ///< Rate of decay [1/length]; negative for growth.
      length = 1; ///< Upper end of the interval.

  TrimmedExponential() = default;
  /// An exponential distribution on [0, length] with the given rate.
  TrimmedExponential(S rate_, S length_) : rate(rate_), length(length_) {
    using std::isfinite;
    require(
        isfinite(rate) && is_valid_scale(length) && isfinite(S(rate * length)) &&
            (flat(magnitude() * length) || is_valid_scale(S(1 / magnitude()))),
        "TrimmedExponential: rate {}, length {}: both and their product must be finite, length > 0, and neither length "
        "nor 1 / rate denormal or next to the largest number",
        static_cast<double>(rate), static_cast<double>(length));
  }

  Domain domain() const { return {S(0), length}; }
  S sample(S u) const {
    using std::expm1, std::exp, std::log, std::log1p, std::max, std::min;
    const S a = magnitude(), k = a * length;
    if (flat(k)) return min(S(u * length), length);
    // With 1 - u = 1 the sample would be the far end, where the density may underflow.
    const S v = rate < 0 ? S(min(S(1 - u), one_minus_epsilon<S>)) : u;
    const S tail = rate < 0 ? S(max(u, S(1 - one_minus_epsilon<S>))) : S(1 - u); // 1 - v without its rounding
    const S rest = k > 1 && v > S(0.5) ? S(log(S(tail + v * S(exp(S(-k)))))) : S(log1p(S(v * S(expm1(S(-k))))));
    const S t = min(S(-rest / a), length);
    return rate < 0 ? S(length - t) : t;
  }
  S pdf(S x) const {
    using std::exp, std::expm1;
    if (!(x >= 0 && x <= length)) return S(0);
    const S a = magnitude(), k = a * length;
    return flat(k) ? S(1 / length) : S(a * S(exp(S(-a * from_dense_end(x)))) / -S(expm1(S(-k))));
  }
  S invert(S x) const {
    using std::expm1;
    const S a = magnitude(), k = a * length;
    if (flat(k)) return clamp_to_unit<S>(x / length);
    const S v = S(expm1(S(-a * from_dense_end(x)))) / S(expm1(S(-k)));
    return clamp_to_unit(rate < 0 ? S(1 - v) : v);
  }
  template <Real T> TrimmedExponential<T> cast() const { return {T(rate), T(length)}; }

 private:
  S magnitude() const { return rate < 0 ? S(-rate) : rate; }
  S from_dense_end(S x) const { return rate < 0 ? S(length - x) : x; }
  /// Whether the density is constant to rounding: e^-k differs from 1 by less than half an ulp.
  static bool flat(const S& k) { return k < std::numeric_limits<S>::epsilon() / 4; }
};

} // namespace mc
