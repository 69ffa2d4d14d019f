#pragma once
/// Thin intervals of the unit cube that hold more or fewer samples than any right sampler puts there.

#include <mc/check/fit/expected/interval_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>

#include <array>
#include <vector>

namespace mc {

/// An interval across one axis, between two values of its coordinate.
///   atom : a few units in the last place wide, where the most samples are: a clamp or a fallback value puts an atom
///          there that no cell is small enough to see
///   gap  : empty, and wide against the spacing of the samples beside it: a wrong constant or a clamp leaves a hole
///          there
struct AxisInterval {
  enum class Kind : std::uint8_t { atom, gap } kind = Kind::atom;
  std::size_t axis = 0;
  UnitBox box;
  double count = 0;           ///< samples in it
  EstimatedMass mass;         ///< claimed by the density
  bool at_end = false;        ///< at the least or the greatest sample, of a gap: beyond it
  double equal = 0;           ///< of an atom: samples that are the same up to rounding
  double pairs_elsewhere = 0; ///< of an atom: neighbours at other places that are the same
};

/// Per axis the place where most samples share one value up to rounding, if three or more do; the least and the
/// greatest value, if two or more share it; and the gaps that are widest in spacings of the samples beside them: the
/// widest inside, and those at both ends. `sorted` holds the coordinates of the samples by axis.
std::vector<AxisInterval> find_axis_intervals(const Subject& s, const Pilot& pilot,
                                              const std::array<std::vector<double>, 3>& sorted);

/// The intervals of one kind against their mass, on the side that the kind suspects: too many at an atom, none in a gap. A
/// interval was chosen among as many as there are samples, which the p-value takes into account; four standard deviations
/// of the mass are conceded. An atom must also be more than chance makes of steps as coarse as the pairs elsewhere say:
/// a sampler of 31 random bits, as coarse as is let pass, repeats itself, but hardly ever in its greatest value. Spends
/// alpha_share(atoms) or alpha_share(gaps).
///   n, mass : samples drawn; what the density integrates to, 1 where samples may fail
Check test_axis_intervals(const Subject& s, AxisInterval::Kind kind, const std::vector<AxisInterval>& intervals,
                          double n, double mass, double alpha);

} // namespace mc
