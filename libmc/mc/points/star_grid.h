#pragma once
/// Grid of the coordinates of a point set, and a lower bound of the star discrepancy on it.

#include <mc/points/point_list.h>

#include <cstdint>
#include <vector>

namespace mc {

/// The distinct coordinates of the points along each axis in ascending order, preceded by 0 and followed by 1. A point
/// is represented by its ranks, the positions of its coordinates in these lists. The boxes [0, y) and [0, y] of largest
/// error have corners on this grid, so ranks represent boxes too.
class StarGrid {
 public:
  /// The grid of `points`.
  explicit StarGrid(PointList points);

  /// Number of dimensions.
  std::size_t dim() const { return axes_.size(); }
  /// Number of points.
  std::size_t size() const { return size_; }
  /// Coordinates along axis k, from 0 to 1.
  const std::vector<double>& axis(std::size_t k) const { return axes_[k]; }
  /// Ranks of point i, one for each axis.
  const std::uint32_t* ranks(std::size_t i) const { return ranks_.data() + i * axes_.size(); }
  /// Indices of the points in ascending order of their ranks along axis k.
  const std::vector<std::uint32_t>& order(std::size_t k) const { return orders_[k]; }

 private:
  std::size_t size_;
  std::vector<std::vector<double>> axes_;
  std::vector<std::uint32_t> ranks_;
  std::vector<std::vector<std::uint32_t>> orders_;
};

/// Lower bound of the star discrepancy, often equal to it. Starts at `starts` random corners and moves one coordinate
/// at a time to the place of largest error, until no move increases the error. Draws large corners more often, because
/// boxes of large error are large [GnewuchWahlstromWinzen12]. The line search is our own.
///   cost : About 5 n dim^2 operations per start.
double star_ascent(const StarGrid& grid, int starts);

} // namespace mc
