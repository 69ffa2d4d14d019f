#pragma once
/// The star discrepancy: the worst box.

#include <mc/points/point_list.h>

#include <cstdint>

namespace mc {

/// Bounds of the star discrepancy; lower = upper where it was found exactly.
struct StarDiscrepancy {
  double lower = 0, upper = 1;
  bool exact() const { return lower == upper; }
};

/// The largest |share of the points in the box - volume| over all boxes [0, y) and [0, y] of the unit cube.
///   method : branch and bound over boxes between coordinates of the points; the one that may hide most is halved next.
///            The bounds hold to rounding whenever it stops
///   work   : points looked at, some 3 ns each. 1e9 suffice for 4096 points of Sobol' in two dimensions, 256 in three,
///            64 in four; beyond that the bounds stay apart, since the problem is hard [GnewuchWahlstromWinzen12]
///   Source : bounds of a box as in [Thiemard01]
StarDiscrepancy star_discrepancy(PointList points, std::uint64_t work = 1'000'000'000);

} // namespace mc
