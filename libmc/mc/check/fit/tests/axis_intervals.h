#pragma once
/// Tests for thin intervals of the unit cube that contain too many or too few samples.

#include <mc/check/fit/expected/interval_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>

#include <array>
#include <vector>

namespace mc {

/// An interval between two values of one coordinate.
///   atom : a few units in the last place wide, at the most frequent value. A clamp or a fallback value creates an atom
///          that is much smaller than a cell.
///   gap  : an empty interval that is wide compared with the spacing of the samples next to it. A wrong constant or a
///          clamp leaves such a hole.
struct AxisInterval {
  enum class Kind : std::uint8_t { atom, gap } kind = Kind::atom;
  std::size_t axis = 0;
  UnitBox box;
  double count = 0;           ///< number of samples in the interval
  EstimatedMass mass;         ///< mass of the claimed density
  bool at_end = false;        ///< at the smallest or the largest sample; a gap lies beyond it
  double equal = 0;           ///< atoms only: number of samples that are equal up to rounding
  double per_length = 0;      ///< atoms only: number of samples per length of the axis nearby
  double pairs_elsewhere = 0; ///< atoms only: number of equal neighbours elsewhere on the axis
};

/// Returns the candidate intervals of each axis. Atoms: the most frequent value up to rounding, if at least three
/// samples share it, and the smallest and the largest value, if at least two samples share it. Gaps: the widest gap
/// inside and the gaps at both ends, measured in spacings of the samples next to them. `sorted` contains the sorted
/// coordinates of the samples for each axis.
std::vector<AxisInterval> find_axis_intervals(const Subject& s, const Pilot& pilot,
                                              const PerAxis<std::vector<double>>& sorted);

/// Tests the intervals of one kind against their mass, one-sided: too many samples in an atom, none in a gap. An
/// interval is one of n candidates, which the p-value takes into account; four standard deviations of the mass are
/// conceded. An atom must also be unlikely for samples rounded to coarse steps. The width of the steps follows from the
/// number of equal pairs elsewhere, with 31 random bits as the coarsest accepted steps: such samples repeat values, but
/// rarely the largest value.
///   n    : number of samples drawn.
///   mass : integral of the density; 1 if samples may fail.
///   share : share of alpha that the test spends.
Check test_axis_intervals(const Subject& s, AxisInterval::Kind kind, const std::vector<AxisInterval>& intervals,
                          double n, double mass, double share, double alpha);

} // namespace mc
