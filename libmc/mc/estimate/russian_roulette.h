#pragma once
/// Random termination and multiplication of an estimate without bias.

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <cstdint>
#include <limits>

namespace mc {

/// Whether to go on with an estimate, and the factor that keeps its mean.
///   survives : with probability `probability`, decided by u in [0,1); `weight` is then 1 / probability, else 0
///   error    : a probability is met to the spacing of u: 1.4e-3 of 1e-5 is too much where u is a float of 24 bits, and
///              below 2^-24 (2^-53 in double) only a finer u keeps the mean
///   throws   : Error unless the probability is at most 1 and at least the smallest normal number: with probability 0
///              what is cut off could not be made up for
///   Source   : [ArvoKirk90]
template <Real S> struct Roulette {
  bool survives;
  S weight;
};
template <Real S> Roulette<S> russian_roulette(S probability, S u) {
  require(probability >= std::numeric_limits<S>::min() && probability <= 1,
          "russian_roulette: survival probability {} must lie in (0, 1], and not below {:.3g}",
          static_cast<double>(probability), static_cast<double>(std::numeric_limits<S>::min()));
  return u < probability ? Roulette<S>{true, 1 / probability} : Roulette<S>{false, S(0)};
}

/// How many independent continuations an estimate gets, and the factor on each that keeps its mean.
///   copies : the number next below or above `expected`, decided by u in [0,1), so that its mean is `expected`; below 1
///            this is Russian roulette. `weight` is 1 / expected
///   error  : as russian_roulette, of what `expected` exceeds a whole number by
///   throws : Error unless `expected` is at least the smallest normal number and at most 2^20: more copies are a fault
///            of whoever asks for them
///   Source : [ArvoKirk90]
template <Real S> struct Splitting {
  std::uint32_t copies;
  S weight;
};
template <Real S> Splitting<S> split(S expected, S u) {
  require(expected >= std::numeric_limits<S>::min() && expected <= S(1 << 20),
          "split: expected number of copies {} must lie in (0, 2^20], and not below {:.3g}",
          static_cast<double>(expected), static_cast<double>(std::numeric_limits<S>::min()));
  const auto least = static_cast<std::uint32_t>(expected);
  return {least + (u < expected - S(least) ? 1u : 0u), 1 / expected};
}

} // namespace mc
