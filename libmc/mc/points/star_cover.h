#pragma once
/// Branch and bound over all boxes for the star discrepancy.

#include <mc/points/star_grid.h>

#include <cstdint>

namespace mc {

/// Searches all boxes [0, y) and [0, y] for the largest error |share of points - volume|. Works on parts, which are
/// sets of boxes with y between two corners.
///   discard : A part is discarded if no box in it can have an error above `bound`.
///   solve   : A part is solved at once if each point enters it along a single axis. The number of points in a box is
///             then the sum of the numbers that entered along each axis. The largest and the smallest volume for each
///             sum are found axis by axis.
///   split   : Any other part is halved.
///   Source  : The parts of [DobkinEppsteinMitchell96], discarded early as in [Thiemard01].
struct StarCover {
  double lower;       ///< Largest error found, starting from its initial value.
  double bound;       ///< Parts without larger errors are discarded.
  std::uint64_t work; ///< Steps left; each takes a few ns.
  /// Runs the search. Returns true if it was completed: then no box has an error above max(lower, bound). Returns false
  /// if `work` ran out.
  bool run(const StarGrid& grid);
};

} // namespace mc
