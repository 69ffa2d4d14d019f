#pragma once
/// Thin slabs of the unit cube that a pilot makes suspect.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <array>
#include <vector>

namespace mc {

/// A slab across one axis, between two values of its coordinate.
///   atom : a few units in the last place wide, where the pilot shows the most samples: a clamp or a fallback value
///          puts an atom there that no cell is small enough to see
///   gap  : empty, and wide against the spacing of the samples beside it: a wrong constant or a clamp leaves a hole
///          there
struct Slab {
  enum class Kind : std::uint8_t { atom, gap } kind = Kind::atom;
  std::size_t axis = 0, pilot_count = 0; ///< pilot samples at an atom
  UnitBox box;
  std::vector<UnitBox>
      pieces; ///< of the slab, cut at the pilot's quantiles of the other axes so that no lobe is missed
  std::uint64_t observed = 0;
  double mass = 0, error = 0; ///< claimed by the density
};

/// At most one atom and three gaps (inside and at both ends) an axis. Chosen from the pilot alone, so that counts of
/// other samples are binomial. `sorted` holds the pilot's coordinates by axis, each sorted.
std::vector<Slab> suspect_slabs(const Subject& s, const std::vector<Subject::Coordinates>& pilot,
                                const std::array<std::vector<double>, 3>& sorted);

/// Fills in mass and error: to a tenth of a sample of n, or 1 %.
void integrate_slabs(const Subject& s, std::vector<Slab>& slabs, double n, std::size_t max_evaluations);

/// The counts of the slabs of one kind against their mass, on the side that the kind suspects: too many at an atom, too
/// few in a gap. Spends alpha_share(atoms) or alpha_share(gaps).
///   n, mass : samples counted; what the density integrates to, 1 where samples may fail
Check test_slabs(const Subject& s, Slab::Kind kind, const std::vector<Slab>& slabs, double n, double mass,
                 double alpha);

} // namespace mc
