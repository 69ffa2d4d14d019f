#pragma once
/// A density that follows an integrand.

#include <mc/estimate/adapt/importance_grid.h>
#include <mc/estimate/adapt/importance_tree.h>

#include <optional>
#include <span>

namespace mc {

/// What was learned of where an integrand is: a grid that follows each axis, and within it, where that pays, a tree of
/// boxes for what is no product of axes.
///   map     : u in [0,1)^dim -> through the tree, then through the grid -> x in [0,1)^dim
///   density : of x [1/volume]; the product of the two
struct AdaptedDensity {
  ImportanceGrid grid;
  std::optional<BoxTree> tree = {};

  int dim() const { return grid.dim(); }
  /// Maps u to x, in place, and returns |dx/du| = 1 / density.
  double map(std::span<double> u) const { return (tree ? tree->map(u) : 1.0) * grid.map(u); }
  /// The density at x; `scratch` has room for its coordinates.
  double density(std::span<const double> x, std::span<double> scratch) const;
};

} // namespace mc
