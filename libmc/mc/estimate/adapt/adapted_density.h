#pragma once
/// Densities learned from an integrand.

#include <mc/estimate/adapt/importance_grid.h>
#include <mc/estimate/adapt/importance_tree.h>

#include <optional>
#include <span>

namespace mc {

/// Density learned from an integrand: a grid that adapts to each axis and optionally, within the grid, a tree of boxes
/// for integrands that are no product over the axes.
///   map     : u in [0,1)^dim -> tree -> grid -> x in [0,1)^dim.
///   density : The product of both densities at x [1/volume].
struct AdaptedDensity {
  ImportanceGrid grid;              ///< Grid that adapts to each axis.
  std::optional<BoxTree> tree = {}; ///< Tree in the coordinates of the grid.

  /// Number of dimensions.
  int dim() const { return grid.dim(); }
  /// Maps u to x in place. Returns |dx/du| = 1 / density.
  double map(std::span<double> u) const { return (tree ? tree->map(u) : 1.0) * grid.map(u); }
  /// Density at x. `scratch` must have room for the coordinates of x.
  double density(std::span<const double> x, std::span<double> scratch) const;
};

} // namespace mc
