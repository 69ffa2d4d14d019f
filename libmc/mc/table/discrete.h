#pragma once
/// Discrete distributions without a table.

#include <mc/core/error.h>
#include <mc/table/concept.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace mc {

/// The outcomes 0 .. n - 1, each with probability 1 / n.
///   sample_index : floor(u n).
///   error        : the share of u that selects an outcome differs from 1 / n by at most twice the spacing of u.
///   throws       : Error unless 1 <= n <= 2^24.
template <Real S> class UniformDiscrete {
 public:
  using Scalar = S;

  /// Uniform distribution over n outcomes.
  explicit UniformDiscrete(std::size_t n) : n_(static_cast<S>(static_cast<double>(n))), pmf_(1 / n_) {
    require(n >= 1 && n <= (1u << 24), "UniformDiscrete: {} outcomes; 1 to 2^24 are supported", n);
  }

  DiscreteSample<S> sample_index(S u) const {
    using std::floor;
    // Below n for every u < 1: n (1 - ulp) lies more than half a step of S below n.
    const S scaled = u * n_, i = floor(scaled);
    return {static_cast<std::size_t>(static_cast<std::int64_t>(i)), pmf_, scaled - i};
  }
  S pmf(std::size_t) const { return pmf_; }
  std::size_t size() const { return static_cast<std::size_t>(static_cast<std::int64_t>(n_)); }
  template <Real T> UniformDiscrete<T> cast() const { return UniformDiscrete<T>(size()); }

 private:
  S n_, pmf_;
};

/// Outcome 1 with probability p, else outcome 0.
///   sample_index : 1 for u < p.
///   error        : the share of u that selects an outcome differs from its pmf by at most the spacing of u.
///   throws       : Error unless 0 <= p <= 1.
template <Real S> class Bernoulli {
 public:
  using Scalar = S;

  /// Distribution with probability p of outcome 1.
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

/// Up to N outcomes with probabilities proportional to their weights. Searches linearly: for a choice that is made
/// once.
///   error  : the share of u that selects an outcome differs from its pmf by at most 2 (size + 1) eps. A weight below
///            the smallest normal number times the sum of weights counts as 0.
///   throws : Error unless there are 1 to N weights, finite and >= 0, with a finite sum > 0.
template <Real S, std::size_t N> class ShortDiscrete {
 public:
  using Scalar = S;

  /// Distribution over weights.size() outcomes.
  explicit ShortDiscrete(std::span<const S> weights) : size_(weights.size()) {
    require(size_ >= 1 && size_ <= N, "ShortDiscrete: {} weights; 1 to {} are supported", size_, N);
    S least = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      weights_[i] = weights[i];
      least = weights[i] < least ? weights[i] : least;
      sum_ += weights[i];
    }
    require(least == 0 && sum_ > 0 && sum_ <= std::numeric_limits<S>::max(),
            "ShortDiscrete: the weights must be finite and >= 0 and their sum, {}, finite and > 0",
            static_cast<double>(sum_));
    using Limits = std::numeric_limits<S>;
    if (sum_ < Limits::min() / Limits::epsilon()) [[unlikely]] { // denormals have too few bits for u times the sum
      for (std::size_t i = 0; i < size_; ++i) weights_[i] /= sum_;
      sum_ = 1;
    }
    const S smallest = Limits::min() * sum_;
    for (std::size_t i = 0; i < size_; ++i) weights_[i] = weights_[i] < smallest ? S(0) : weights_[i];
  }

  DiscreteSample<S> sample_index(S u) const {
    S rest = u * sum_;
    std::size_t last = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (rest < weights_[i]) {
        const S again = rest / weights_[i];
        return {i, pmf(i), again < 1 ? again : one_minus_epsilon<S>};
      }
      rest -= weights_[i];
      if (weights_[i] > 0) last = i;
    }
    return {last, pmf(last), one_minus_epsilon<S>}; // rounding may leave a small rest for the last u
  }
  S pmf(std::size_t i) const { return weights_[i] / sum_; }
  std::size_t size() const { return size_; }

 private:
  std::array<S, N> weights_; ///< The first size_ entries are in use.
  std::size_t size_;
  S sum_ = 0;
};

} // namespace mc
