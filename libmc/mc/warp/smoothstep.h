#pragma once
/// The smooth step as a density.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Density on [0,1] proportional to the smooth step 3 x^2 - 2 x^3.
///   sample : root of x^3 (2 - x) = u by Newton's method from cbrt(u). u below eps / 4, half a step, is replaced by eps
///            / 4.
///   pdf    : 2 x^2 (3 - 2 x) [1/length]; 0 outside.
///   invert : |invert(sample(u)) - u| <= 8 eps.
/// The CDF is convex and the start lies above the root, so the iterates decrease to the root. The first iterate that
/// does not decrease ends the loop. One last step with twice the digits makes the sample monotone in u.
template <Real S> struct Smoothstep {
  using Scalar = S;
  using Domain = Interval<S>;

  Domain domain() const { return {}; }
  S sample(S u) const {
    using std::max;
    const S v = max(u, S(std::numeric_limits<S>::epsilon() / 4));
    if constexpr (std::same_as<S, float>) return static_cast<float>(Smoothstep<double>::root(v));
    else return root(v);
  }
  S pdf(S x) const { return x >= 0 && x <= 1 ? S(2 * x * x * (3 - 2 * x)) : S(0); }
  S invert(S x) const { return clamp_to_unit<S>(x * x * x * (2 - x)); }
  template <Real T> Smoothstep<T> cast() const { return {}; }

  /// Solution x of x^3 (2 - x) = v for v > 0.
  static S root(const S& v) {
    using std::cbrt;
    S x = S(cbrt(v));
    for (;;) {
      const S next = x - (x * x * x * (2 - x) - v) / slope(x);
      if (!(next < x)) break;
      x = next;
    }
    return S(x - excess(x, v) / slope(x));
  }

 private:
  static S slope(const S& x) { return 2 * x * x * (3 - 2 * x); }
  // x^3 (2 - x) - v with twice the digits. The root is then rounded once, so it never decreases as v grows.
  static S excess(const S& x, const S& v) {
    using std::fma;
    const S x2 = x * x, low2 = S(fma(x, x, S(-x2))), x3 = x2 * x, low3 = S(fma(x2, x, S(-x3))) + low2 * x;
    const S rest = 2 - x, low_rest = (2 - rest) - x, cdf = x3 * rest;
    return (cdf - v) + (S(fma(x3, rest, S(-cdf))) + low3 * rest + x3 * low_rest);
  }
};

} // namespace mc
