#include <mc/points/star_cover.h>
#include <mc/points/star_discrepancy.h>

#include <algorithm>
#include <cmath>

namespace mc {

namespace {

// Runs covers with decreasing bounds while work is left. Extrapolates the work for half the bound from the last two
// covers. A cover may spend three quarters of the remaining work and aims at half of that, so that a wrong guess leaves
// some work.
void lower_the_bound(const StarGrid& grid, StarDiscrepancy& found, std::uint64_t work) {
  double ratio = 0.5, before = 1, growth = std::pow(2.0, static_cast<double>(grid.dim()));
  while (ratio < 0.97 && work > grid.size() && !found.exact()) {
    const std::uint64_t share = work - work / 4;
    StarCover cover{found.lower, std::max(found.lower, ratio * found.upper), share};
    const bool whole = cover.run(grid);
    work -= share - cover.work;
    found.lower = cover.lower;
    const double spent = static_cast<double>(share - cover.work);
    const double seen = std::pow(spent / before, std::log(0.5) / std::log(ratio));
    if (whole) {
      found.upper = std::max(cover.bound, cover.lower);
      if (before > 1) growth = std::max(3.0, 2 * seen); // the growth itself increases as the bound falls
      before = std::max(spent, 1.0);
    } else {
      growth = 1.5 * std::max(growth, seen);
    }
    const double left = 0.375 * static_cast<double>(work) / before;
    ratio = std::clamp(std::pow(0.5, std::log(left) / std::log(growth)), 0.5, 0.97);
  }
}

} // namespace

double exact_star_steps(std::size_t count, std::size_t dim) {
  return (dim > 5 ? 0.0075 : 0.15) * std::pow(static_cast<double>(count), 0.5 * static_cast<double>(dim) + 1);
}

StarDiscrepancy star_discrepancy(PointList points, std::uint64_t work) {
  require_unit_points(points);
  const StarGrid grid(points);
  const double start_cost = 10.0 * static_cast<double>(points.values.size()) * static_cast<double>(points.dim);
  const int starts = static_cast<int>(std::clamp(static_cast<double>(work) / 16 / start_cost, 1.0, 64.0));
  StarDiscrepancy found{star_ascent(grid, starts), 1};
  const bool within_reach = exact_star_steps(points.size(), points.dim) < 0.75 * static_cast<double>(work);
  StarCover exact{found.lower, found.lower, within_reach ? work / 4 * 3 : work / 8};
  const std::uint64_t share = exact.work;
  const bool whole = exact.run(grid);
  found.lower = exact.lower;
  if (whole) found.upper = exact.lower;
  else lower_the_bound(grid, found, work - share);
  return found;
}

} // namespace mc
