#pragma once
/// Measures of uniformity of a point set in the unit cube: L2 discrepancies and the smallest distance.

#include <mc/points/point_list.h>

namespace mc {

/// L2 star discrepancy: root mean square of (share of the points in the box) - (volume) over all boxes [0, y), y
/// uniform in the cube.
///   cost   : n^2 dim / 2 operations.
///   error  : The square is accurate to 1e-13 of 3^-dim.
///   random : The mean square for n independent points is (2^-dim - 3^-dim) / n.
///   Source : [Warnock72].
double l2_star_discrepancy(PointList points);

/// Periodic L2 discrepancy: the same root mean square over all boxes that may wrap around the faces of the cube, with
/// uniform corners and lengths. It treats all corners of the cube equally.
///   cost, error, random : As for l2_star_discrepancy().
///   Source : [HinrichsOettershagen16].
double periodic_l2_discrepancy(PointList points);

/// The wrap-around and the centered L2 discrepancy. Both add the same mean squares over all faces of the cube, and so
/// also measure the uniformity of projections. Returns the square root; SciPy prints the square under the same name.
/// Infinity where a square is beyond doubles, in more than 1100 dimensions.
///   Source : [Hickernell98].
double wraparound_discrepancy(PointList points);
/// Centered L2 discrepancy, as defined at wraparound_discrepancy().
double centered_discrepancy(PointList points);
/// Mixture L2 discrepancy: its kernel mixes those of the wrap-around and of the centered one. Returns the square root,
/// as above.
///   Source : [ZhouFangNing13].
double mixture_discrepancy(PointList points);

/// All L2 discrepancies of a point set, or their root mean squares over several sets.
struct L2Discrepancies {
  double star = 0,    ///< l2_star_discrepancy()
      periodic = 0,   ///< periodic_l2_discrepancy()
      centered = 0,   ///< centered_discrepancy()
      wraparound = 0, ///< wraparound_discrepancy()
      mixture = 0;    ///< mixture_discrepancy()
};
/// Computes all of them in one pass over the pairs, with the same bits as the functions above.
L2Discrepancies l2_discrepancies(PointList points);
/// Root mean squares for `count` independent points: sqrt((a^dim - b^dim) / count), with (a, b) = (1/2, 1/3) for star
/// and periodic, (5/4, 13/12) for centered, (3/2, 4/3) for wrap-around and (7/4, 19/12) for mixture.
L2Discrepancies random_l2_discrepancies(double count, int dim);

/// Expected squared L2 star and periodic discrepancies, for comparison with a point set.
///   random   : `count` independent points, for both discrepancies.
///   jittered : `count` = m^dim jittered points, one in each cell of a grid. If m is not whole, returns the value of
///              the formula.
double random_mean_square(double count, int dim);
/// Expected squared L2 star discrepancy of `count` jittered points.
double jittered_star_mean_square(double count, int dim);
/// Expected squared periodic L2 discrepancy of `count` jittered points.
double jittered_periodic_mean_square(double count, int dim);

/// Smallest distance of two points in the cube, with and without wrapping around its faces.
struct SmallestDistance {
  double plain, ///< Distance in the cube; infinity for a single point.
      periodic; ///< Distance with wrapping; infinity for a single point.
};
/// Smallest distances of a point set.
///   cost   : At most n^2 dim operations. Less if the first axis separates the points.
///   random : The mean periodic distance of n independent points tends to Gamma(1 + 1/dim) (2 / (n^2 V))^(1/dim) if
///            that is well below 1/2 [SilvermanBrown78]. V is the volume of the unit ball.
SmallestDistance smallest_distance(PointList points);

} // namespace mc
