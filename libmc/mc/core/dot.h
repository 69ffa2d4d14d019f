#pragma once
/// Dot product that stays accurate when the terms nearly cancel.

#include <mc/core/types.h>

namespace mc {

/// Dot product a . b, accurate as if computed with twice the digits of S and rounded once at the end.
///   error  : |result - a.b| <= eps |a.b| + 8 eps^2 |a| |b|.
///   Source : Dot2 of [OgitaRumpOishi05]. The float version computes in double, where products of floats are exact.
template <Real S, int N> S accurate_dot(const Vec<S, N>& a, const Vec<S, N>& b) {
  if constexpr (std::same_as<S, float>) {
    return static_cast<float>(a.template cast<double>().dot(b.template cast<double>()));
  } else if constexpr (std::floating_point<S>) {
    S sum = a[0] * b[0], low = std::fma(a[0], b[0], -sum);
    for (int i = 1; i < N; ++i) {
      const S p = a[i] * b[i], t = sum + p, v = t - sum;
      low += std::fma(a[i], b[i], -p) + ((sum - (t - v)) + (p - v));
      sum = t;
    }
    return sum + low;
  } else {
    return a.dot(b);
  }
}
/// Same for three components, with deduced size.
template <Real S> S accurate_dot(const Vec3<S>& a, const Vec3<S>& b) { return accurate_dot<S, 3>(a, b); }

} // namespace mc
