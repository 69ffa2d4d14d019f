#include <mc/estimate/adapt/adapted_density.h>

#include <algorithm>

namespace mc {

double AdaptedDensity::density(std::span<const double> x, std::span<double> scratch) const {
  if (!tree) return grid.density(x);
  std::copy(x.begin(), x.end(), scratch.begin());
  const double of_grid = grid.invert(scratch);
  return of_grid * tree->density(tree->leaf_of_x(scratch));
}

} // namespace mc
