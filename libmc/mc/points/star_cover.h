#pragma once
/// All boxes that may be worst, part by part.

#include <mc/points/star_grid.h>

#include <cstdint>

namespace mc {

/// Goes through all boxes [0, y) and [0, y] in parts that lie between two corners. A part whose boxes are all off by
/// `bound` at most is left out. One along whose axes the points come in one by one, each along one axis alone, is
/// solved at once: how many points a box holds is then the sum of those that came along each axis, and of each sum the
/// largest and the smallest volume are found axis by axis. Any other is halved.
///   work   : steps to be taken; each costs some ns
///   Source : the parts of [DobkinEppsteinMitchell96], left out early as in [Thiemard01]
struct StarCover {
  double lower;       ///< the worst box that was met, or what it was at the beginning
  double bound;       ///< parts whose boxes are off by no more are left out
  std::uint64_t work; ///< steps left
  /// Whether there was work enough; then no box is off by more than the larger of lower and bound.
  bool run(const StarGrid& grid);
};

} // namespace mc
