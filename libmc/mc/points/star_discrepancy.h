#pragma once
/// Star discrepancy of a point set.

#include <mc/points/point_list.h>

#include <cstddef>
#include <cstdint>

namespace mc {

/// Bounds of the star discrepancy.
struct StarDiscrepancy {
  double lower = 0, ///< Lower bound.
      upper = 1;    ///< Upper bound, equal to `lower` if the value was found exactly.
  /// Whether the value was found exactly.
  bool exact() const { return lower == upper; }
};

/// Bounds the star discrepancy: the largest |share of the points in the box - volume| over all boxes [0, y) and [0, y]
/// of the unit cube.
///   method : A local search finds a box with a large error. A cover of all boxes then discards the boxes with smaller
///            errors and solves the rest exactly, in about n^(dim/2 + 1) steps. If `work` does not suffice for that,
///            covers that discard increasingly more boxes give the upper bound. The bounds hold up to rounding.
///   work   : Number of steps of a few ns each. The default is exact for moderate sets in two to five dimensions. For
///            larger sets the bounds remain apart, because the problem is hard [GnewuchWahlstromWinzen12].
///   Source : [DobkinEppsteinMitchell96], [Thiemard01]; star_cover.h has the details.
StarDiscrepancy star_discrepancy(PointList points, std::uint64_t work = 1'000'000'000);

/// Estimated number of steps for an exact answer: 0.15 n^(dim/2 + 1). The estimate may be up to 20 times too large from
/// 6 dimensions on. If `work` is less than 4/3 of it, star_discrepancy() makes little attempt at an exact answer.
double exact_star_steps(std::size_t count, std::size_t dim);

} // namespace mc
