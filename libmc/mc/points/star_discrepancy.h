#pragma once
/// The star discrepancy: the worst box.

#include <mc/points/point_list.h>

#include <cstddef>
#include <cstdint>

namespace mc {

/// Bounds of the star discrepancy; lower = upper where it was found exactly.
struct StarDiscrepancy {
  double lower = 0, upper = 1;
  bool exact() const { return lower == upper; }
};

/// The largest |share of the points in the box - volume| over all boxes [0, y) and [0, y] of the unit cube.
///   method : a local search finds a box that is bad; a cover of all boxes then leaves out what is not worse and solves
///            the rest exactly, in some n^(dim/2 + 1) steps. A part of the work is kept for covers, where that does
///            not last, that leave out ever more, which bound the worst box from above. The bounds hold to rounding
///   work   : steps, some 3 ns each. 1e9 suffice for 32768 points of Sobol' in two dimensions, 8192 in three, 1024 in
///            four, 512 in five; beyond that the bounds stay apart, since the problem is hard
///            [GnewuchWahlstromWinzen12]
///   Source : [DobkinEppsteinMitchell96], [Thiemard01]; see star_cover.h
StarDiscrepancy star_discrepancy(PointList points, std::uint64_t work = 1'000'000'000);

/// About the steps that an exact answer takes, from measurements: 0.15 n^(dim/2 + 1), from 6 dimensions on up to 20
/// times less. Where a third more is not there, star_discrepancy hardly tries.
double exact_star_steps(std::size_t count, std::size_t dim);

} // namespace mc
