#pragma once
/// How evenly points fill the unit cube: discrepancies that are means of squares, and the nearest two.

#include <mc/points/point_list.h>

namespace mc {

/// The root mean square, over all boxes [0, y) with y uniform in the cube, of (share of the points in the box) -
/// (volume).
///   cost   : n^2 dim / 2
///   error  : the square is known to 1e-13 of 3^-dim
///   random : the mean square of n independent points is (2^-dim - 3^-dim) / n
///   Source : [Warnock72]
double l2_star_discrepancy(PointList points);

/// The same over all boxes that may wrap around the faces of the cube, corners and lengths uniform: no corner is
/// special.
///   cost, error, random : as l2_star_discrepancy
///   Source : [HinrichsOettershagen16]
double periodic_l2_discrepancy(PointList points);

/// The wrap-around and the centered discrepancy, which add the same over all faces: uniformity of the projections too.
/// Both are square roots; programs that print the square call it the discrepancy as well.
///   Source : [Hickernell98]
double wraparound_discrepancy(PointList points);
double centered_discrepancy(PointList points);

/// Mean squares of the star and the periodic discrepancy of `count` jittered points, one in each cell of a grid of
/// m^dim = count cells; m need not be whole, the square is then that of the formula. Of independent points:
/// random_mean_square, for both.
double random_mean_square(double count, int dim);
double jittered_star_mean_square(double count, int dim);
double jittered_periodic_mean_square(double count, int dim);

/// Smallest distance of two of the points in the plain and the periodic cube; infinity for one point.
///   cost   : n^2 dim at most, less where the first axis tells points apart
///   random : the mean periodic one of n independent points tends to Gamma(1 + 1/dim) (2 / (n^2 V))^(1/dim) with the
///            volume V of the unit ball, where that is well below 1/2 [SilvermanBrown78]
struct SmallestDistance {
  double plain, periodic;
};
SmallestDistance smallest_distance(PointList points);

} // namespace mc
