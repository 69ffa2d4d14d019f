#pragma once
/// Unbiased random termination and splitting of estimates.

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <cstdint>
#include <limits>

namespace mc {

/// Result of russian_roulette().
template <Real S> struct Roulette {
  bool survives; ///< Whether the estimate continues.
  S weight;      ///< Factor on a surviving estimate that keeps its mean: 1 / probability, or 0.
};
/// Decides with u in [0,1) whether an estimate continues. It survives with probability `probability`.
///   error  : The survival probability is rounded to the spacing of u. Below 2^-24 for float, or 2^-53 for double, the
///            mean is not kept.
///   throws : Error unless the probability is at most 1 and at least the smallest normal number. Probability 0 would
///            lose the contribution.
///   Source : [ArvoKirk90].
template <Real S> Roulette<S> russian_roulette(S probability, S u) {
  require(probability >= std::numeric_limits<S>::min() && probability <= 1,
          "russian_roulette: survival probability {} must lie in (0, 1], and not below {:.3g}",
          static_cast<double>(probability), static_cast<double>(std::numeric_limits<S>::min()));
  return u < probability ? Roulette<S>{true, 1 / probability} : Roulette<S>{false, S(0)};
}

/// Result of split().
template <Real S> struct Splitting {
  std::uint32_t copies; ///< Number of independent continuations.
  S weight;             ///< Factor on each continuation that keeps the mean: 1 / expected.
};
/// Decides with u in [0,1) on the number of continuations: one of the two integers next to `expected`, with mean
/// `expected`. Below 1 this is Russian roulette.
///   error  : As for russian_roulette(), for the fractional part of `expected`.
///   throws : Error unless `expected` is at least the smallest normal number and at most 2^20. More copies indicate an
///            error of the caller.
///   Source : [ArvoKirk90].
template <Real S> Splitting<S> split(S expected, S u) {
  require(expected >= std::numeric_limits<S>::min() && expected <= S(1 << 20),
          "split: expected number of copies {} must lie in (0, 2^20], and not below {:.3g}",
          static_cast<double>(expected), static_cast<double>(std::numeric_limits<S>::min()));
  const auto least = static_cast<std::uint32_t>(expected);
  return {least + (u < expected - S(least) ? 1u : 0u), 1 / expected};
}

} // namespace mc
