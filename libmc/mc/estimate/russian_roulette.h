#pragma once
/// Random termination without bias.

#include <mc/core/error.h>
#include <mc/core/types.h>

namespace mc {

/// Whether to go on with an estimate, and the factor that keeps its mean.
///   survives : with probability `probability`, decided by u in [0,1); `weight` is then 1 / probability, else 0
///   throws   : Error unless 0 < probability <= 1: with probability 0 what is cut off could not be made up for
///   Source   : [ArvoKirk90]
template <Real S> struct Roulette {
  bool survives;
  S weight;
};
template <Real S> Roulette<S> russian_roulette(S probability, S u) {
  require(probability > 0 && probability <= 1, "russian_roulette: survival probability {} must lie in (0, 1]", static_cast<double>(probability));
  return u < probability ? Roulette<S>{true, 1 / probability} : Roulette<S>{false, S(0)};
}

} // namespace mc
