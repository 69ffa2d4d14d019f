#pragma once
/// Discrete distributions that need no table.

#include <mc/core/error.h>
#include <mc/table/concept.h>

#include <cstdint>

namespace mc {

/// The outcomes 0 .. n - 1, each with probability 1 / n.
///   sample_index : floor(u n)
///   error        : the share of u that meets an outcome differs from 1 / n by at most twice the spacing of u
///   throws       : Error unless 1 <= n <= 2^24
template <Real S> class UniformDiscrete {
 public:
  using Scalar = S;

  explicit UniformDiscrete(std::size_t n) : n_(static_cast<S>(static_cast<double>(n))), pmf_(1 / n_) {
    require(n >= 1 && n <= (1u << 24), "UniformDiscrete: {} outcomes; 1 to 2^24 are supported", n);
  }

  DiscreteSample<S> sample_index(S u) const {
    using std::floor;
    // Below n for every u below 1: the product of n and 1 - ulp lies more than half a step of S below n.
    const S scaled = u * n_, i = floor(scaled);
    return {static_cast<std::size_t>(static_cast<std::int64_t>(i)), pmf_, scaled - i};
  }
  S pmf(std::size_t) const { return pmf_; }
  std::size_t size() const { return static_cast<std::size_t>(static_cast<std::int64_t>(n_)); }
  template <Real T> UniformDiscrete<T> cast() const { return UniformDiscrete<T>(size()); }

 private:
  S n_, pmf_;
};

/// Outcome 1 with probability p, else 0.
///   sample_index : 1 for u < p
///   error        : the share of u that meets an outcome differs from its pmf by at most the spacing of u
///   throws       : Error unless 0 <= p <= 1
template <Real S> class Bernoulli {
 public:
  using Scalar = S;

  explicit Bernoulli(S p) : p_(p) {
    require(p >= 0 && p <= 1, "Bernoulli: probability {} must lie in [0, 1]", static_cast<double>(p));
  }

  DiscreteSample<S> sample_index(S u) const {
    const bool one = u < p_;
    const S chance = pmf(one), rest = (one ? u : S(u - p_)) / chance;
    return {one, chance, rest < 1 ? rest : one_minus_epsilon<S>};
  }
  S pmf(std::size_t i) const { return i == 1 ? p_ : S(1 - p_); }
  std::size_t size() const { return 2; }
  template <Real T> Bernoulli<T> cast() const { return Bernoulli<T>(T(p_)); }

 private:
  S p_;
};

} // namespace mc
