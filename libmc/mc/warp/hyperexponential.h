#pragma once
/// Mixtures of exponential distributions.

#include <mc/core/error.h>
#include <mc/core/log.h>
#include <mc/domain/interval.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <array>

namespace mc {

/// Hyperexponential distribution on [0, inf): exponential with one of N rates, which is chosen at random. The distance
/// to the next collision in a medium of N colour channels follows it. Unlike a MixtureN of Exponential it has a tail(),
/// admits rates of 0 and needs no memory.
///   sample : x = -log(1 - u') / rate_i, with u' the part of u within the share p_i; infinite if rate_i = 0.
///   pdf    : sum of p_i rate_i exp(-rate_i x) [1/length] at a finite x; 0 for x < 0. Relative error
///            (2 N + 4 + max(rate) x) eps.
///   tail   : probability of more than x, the sum of p_i exp(-rate_i x).
///   invert : none, because several u give the same x.
///   throws : Error unless the weights are finite and >= 0 with a sum > 0, and the rates finite and >= 0. p_i is the
///            weight over the sum.
template <Real S, std::size_t N> class Hyperexponential {
 public:
  using Scalar = S;
  using Domain = HalfLine<S>;

  /// The distribution with these weights and rates [1/length].
  Hyperexponential(const std::array<S, N>& weights, const std::array<S, N>& rates) : rates_(rates) {
    using std::isfinite;
    S sum(0);
    for (std::size_t i = 0; i < N; ++i) {
      require(isfinite(weights[i]) && weights[i] >= 0 && isfinite(rates[i]) && rates[i] >= 0,
              "Hyperexponential: weight {} and rate {} must be finite and >= 0", static_cast<double>(weights[i]),
              static_cast<double>(rates[i]));
      sum += weights[i];
    }
    require(isfinite(sum) && sum > 0, "Hyperexponential: the sum {} of the weights must be finite and > 0",
            static_cast<double>(sum));
    for (std::size_t i = 0; i < N; ++i) {
      probability_[i] = weights[i] / sum;
      if (weights[i] > 0) last_ = i;
    }
  }

  Domain domain() const { return {S(0), S(1 / *std::max_element(rates_.begin(), rates_.end()))}; }
  S sample(S u) const {
    std::size_t i = 0;
    while (i < last_ && u >= probability_[i]) u -= probability_[i++];
    if (rates_[i] == 0) return infinity<S>;
    return -log_of_complement(clamp_to_unit<S>(u / probability_[i])) / rates_[i];
  }
  S pdf(S x) const {
    return x < 0 ? S(0) : sum_of(x, [&](std::size_t i) { return rates_[i]; });
  }
  /// Probability of more than x.
  S tail(S x) const {
    return sum_of(x, [](std::size_t) { return S(1); });
  }
  template <Real T> Hyperexponential<T, N> cast() const {
    std::array<T, N> weights, rates;
    for (std::size_t i = 0; i < N; ++i) weights[i] = T(probability_[i]), rates[i] = T(rates_[i]);
    return {weights, rates};
  }

 private:
  // Sum of p_i factor(i) exp(-rate_i x).
  template <class Factor> S sum_of(S x, const Factor& factor) const {
    using std::exp;
    S sum(0);
    for (std::size_t i = 0; i < N; ++i) sum += probability_[i] * factor(i) * S(exp(S(-rates_[i] * x)));
    return sum;
  }

  std::array<S, N> probability_, rates_;
  std::size_t last_ = 0; ///< The last rate with a weight: it takes what rounding leaves of u.
};

} // namespace mc
