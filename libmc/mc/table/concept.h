#pragma once
/// Discrete distributions.

#include <mc/core/types.h>

#include <concepts>
#include <cstddef>

namespace mc {

/// One outcome of a discrete distribution.
template <Real S> struct DiscreteSample {
  std::size_t index;
  S pmf;        ///< probability of this outcome, > 0
  S u_remapped; ///< uniform in [0,1) again, independent of the index: use it for the next decision
};

/// A distribution over 0 .. size() - 1.
///   sample(u) : u in [0,1) -> an outcome; never one of probability 0, at u = 0 or u = 1 - ulp either
template <class D>
concept DiscreteDistribution = requires(const D d, typename D::Scalar u, std::size_t i) {
  { d.sample_index(u) } -> std::same_as<DiscreteSample<typename D::Scalar>>;
  { d.pmf(i) } -> std::convertible_to<typename D::Scalar>;
  { d.size() } -> std::convertible_to<std::size_t>;
};

} // namespace mc
