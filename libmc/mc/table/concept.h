#pragma once
/// Discrete distributions.

#include <mc/core/types.h>

#include <concepts>
#include <cstddef>

namespace mc {

/// One outcome of a discrete distribution.
template <Real S> struct DiscreteSample {
  std::size_t index; ///< Index of the outcome.
  S pmf;             ///< Probability of this outcome, > 0.
  S u_remapped;      ///< Uniform in [0,1) and independent of the index: use it for the next decision.
};

/// A distribution over the outcomes 0 .. size() - 1.
///   sample_index(u) : maps u in [0,1) to an outcome. Never returns an outcome of probability 0, not even at u = 0 or u
///                     = 1 - ulp.
///   pmf(i)          : probability of outcome i.
template <class D>
concept DiscreteDistribution = requires(const D d, typename D::Scalar u, std::size_t i) {
  { d.sample_index(u) } -> std::same_as<DiscreteSample<typename D::Scalar>>;
  { d.pmf(i) } -> std::convertible_to<typename D::Scalar>;
  { d.size() } -> std::convertible_to<std::size_t>;
};

} // namespace mc
