#pragma once
/// Thin slabs of the unit cube that a pilot makes suspect.

#include <mc/check/fit/partition.h>
#include <mc/check/subject/subject.h>

#include <array>
#include <vector>

namespace mc {

/// A slab across one axis, between two values of its coordinate.
///   crowd : a few units in the last place wide, where the pilot shows the most samples: a clamp or a fallback value
///           puts an atom there that no cell is small enough to see
///   gap   : empty, and wide against the spacing of the samples beside it: a wrong constant or a clamp leaves a hole
///           there
struct Slab {
  enum class Kind : std::uint8_t { crowd, gap } kind = Kind::crowd;
  std::size_t axis = 0, pilot = 0; ///< pilot samples in a crowd
  UnitBox box;
  std::vector<UnitBox>
      pieces; ///< of the slab, cut at the pilot's quantiles of the other axes so that no lobe is missed
  std::uint64_t observed = 0;
  double mass = 0, error = 0; ///< claimed by the density
};

/// At most one crowd and three gaps (inside and at both ends) an axis. Chosen from the pilot alone, so that counts of
/// other samples are binomial. `sorted` holds the pilot's coordinates by axis, each sorted.
std::vector<Slab> suspect_slabs(const Subject& s, const std::vector<Subject::Coordinates>& pilot,
                                const std::array<std::vector<double>, 3>& sorted);

/// Fills in mass and error: to a tenth of a sample of n, or 1 %.
void weigh(const Subject& s, std::vector<Slab>& slabs, double n, std::size_t max_evaluations);

} // namespace mc
