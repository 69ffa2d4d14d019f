#pragma once
/// The smooth step as a density.

#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>

namespace mc {

/// Density on [0,1] proportional to the smooth step 3 x^2 - 2 x^3.
///   sample : the root of x^3 (2 - x) = u by Newton's method from cbrt(u). The CDF is convex and the start lies above
///            the root, so the iterates fall to it; the first that does not fall ends the search. u = 0 stands for half
///            its step
///   pdf    : 2 x^2 (3 - 2 x) [1/length]; 0 outside
///   invert : |invert(sample(u)) - u| <= 8 eps
template <Real S> struct Smoothstep {
  using Scalar = S;
  using Domain = Interval<S>;

  Domain domain() const { return {}; }
  S sample(S u) const {
    using std::cbrt, std::max;
    const S v = max(u, S(std::numeric_limits<S>::epsilon() / 4));
    S x = S(cbrt(v));
    for (;;) {
      const S next = x - (x * x * x * (2 - x) - v) / (2 * x * x * (3 - 2 * x));
      if (!(next < x)) return x;
      x = next;
    }
  }
  S pdf(S x) const { return x >= 0 && x <= 1 ? S(2 * x * x * (3 - 2 * x)) : S(0); }
  S invert(S x) const { return x * x * x * (2 - x); }
  template <Real T> Smoothstep<T> cast() const { return {}; }
};

} // namespace mc
