#pragma once
/// A first sample, independent of the one that is counted: it says where the cells go.

#include <mc/check/fit/draw_tally.h>

#include <array>
#include <vector>

namespace mc {

struct Pilot {
  std::vector<Subject::Coordinates> points;
  std::array<std::vector<double>, 3> sorted; ///< the coordinates of the points, by axis
  DrawTally tally;

  /// The share of the pilot below v on an axis.
  double rank(std::size_t axis, double v) const;
};

/// pilot_samples(samples) draws.
Pilot draw_pilot(const Subject& subject, std::uint64_t seed, std::uint64_t samples);

/// Samples that make the cells: an eighth of those that are counted, at least 1000, at most 2^20, which is 256 for each
/// of 4096 cells.
std::uint64_t pilot_samples(std::uint64_t samples);

} // namespace mc
