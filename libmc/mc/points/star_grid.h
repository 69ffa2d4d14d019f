#pragma once
/// What the search for the worst box stands on: the coordinates of the points along each axis.

#include <mc/points/point_list.h>

#include <cstdint>
#include <vector>

namespace mc {

/// The coordinates that points have along each axis, ascending and each once, with 0 before and 1 behind them. A point
/// is known by its ranks: where its coordinates stand there. Boxes that differ by no coordinate hold the same points,
/// so a box is known by ranks, too: those of [0, y) and [0, y] that are worst have such corners.
class StarGrid {
 public:
  explicit StarGrid(PointList points);

  std::size_t dim() const { return axes_.size(); }
  std::size_t size() const { return size_; }
  const std::vector<double>& axis(std::size_t k) const { return axes_[k]; }
  /// The ranks of point i, one for each axis.
  const std::uint32_t* ranks(std::size_t i) const { return ranks_.data() + i * axes_.size(); }
  /// The points in the order of their ranks along an axis.
  const std::vector<std::uint32_t>& order(std::size_t k) const { return orders_[k]; }

 private:
  std::size_t size_;
  std::vector<std::vector<double>> axes_;
  std::vector<std::uint32_t> ranks_;
  std::vector<std::vector<std::uint32_t>> orders_;
};

/// A lower bound of the star discrepancy that is often the star discrepancy: from `starts` random corners, each
/// coordinate in turn goes where it is worst while the others stay, until none can go on. Large corners are drawn more
/// often, since bad boxes are large [GnewuchWahlstromWinzen12]; the line search is ours.
///   cost : some 5 n dim^2 for each start
double star_ascent(const StarGrid& grid, int starts);

} // namespace mc
