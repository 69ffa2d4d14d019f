#include <mc/points/star_cover.h>
#include <mc/points/star_discrepancy.h>

#include <algorithm>
#include <cmath>

namespace mc {

namespace {

// Covers for ever smaller bounds as long as the work lasts. The work for half the bound is guessed from the last two;
// half of what is left may be spent on each, so that a wrong guess leaves some.
void lower_the_bound(const StarGrid& grid, StarDiscrepancy& found, std::uint64_t work) {
  double ratio = 0.5, before = 0, growth = std::pow(2.0, static_cast<double>(grid.dim()));
  while (ratio < 0.97 && work > grid.size() && !found.exact()) {
    StarCover cover{found.lower, std::max(found.lower, ratio * found.upper), work / 2};
    const bool whole = cover.run(grid);
    const double spent = static_cast<double>(work / 2 - cover.work);
    work -= work / 2 - cover.work;
    found.lower = cover.lower;
    if (!whole) {
      ratio = std::sqrt(ratio);
      continue;
    }
    found.upper = std::max(cover.bound, cover.lower);
    if (before > 0) growth = std::max(1.5, std::pow(spent / before, std::log(0.5) / std::log(ratio)));
    before = spent;
    const double left = 0.3 * static_cast<double>(work) / std::max(spent, 1.0);
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
