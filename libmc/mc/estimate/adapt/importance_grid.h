#pragma once
/// Importance sampling learned from the integrand, separately for each dimension.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Separable map of the unit cube onto itself, piecewise linear in each dimension. It has `bins` intervals of equal
/// probability. Their edges move to where the integrand is large. The number of bins is a power of two. Bin edges in u
/// are then edges of elementary intervals of a Sobol' sequence, so the jumps of the density cause no error.
///   map    : u in [0,1)^dim -> x in [0,1)^dim in place, with the Jacobian |dx/du| = 1 / density.
///   refine : Makes the density in each dimension proportional to the root of the mean of (f / density)^2 over the
///            other dimensions, which is the best separable step. Adds edges at jumps of that density. Bin widths grow
///            gradually away from narrow bins, because the flanks of a peak may contain no point. A tenth of the
///            probability stays uniform, so no region is lost and the Jacobian stays below 12.5 in each dimension. Few
///            points determine only the coarse shape: each estimate of the power of a bin uses at least 8 effective
///            points.
///   Source : [Lepage78].
class ImportanceGrid {
 public:
  /// Number of bins of each dimension.
  static constexpr std::size_t bins = 128;

  /// The uniform grid of `dim` dimensions.
  explicit ImportanceGrid(int dim);
  /// Grid with the given edges of each dimension, one dimension after the other.
  ///   throws : Error unless each dimension has bins + 1 edges from 0 to 1 that never decrease.
  explicit ImportanceGrid(std::vector<double> edges);

  /// Number of dimensions.
  int dim() const { return dim_; }
  /// Maps one point in place and returns the Jacobian.
  double map(std::span<double> u) const;
  /// Density of the mapped points at x in [0,1)^dim, the inverse of the Jacobian.
  double density(std::span<const double> x) const;
  /// Maps one point x back to u in place and returns the density at x.
  double invert(std::span<double> x) const;
  /// Adapts the grid. `power` contains, for each dimension and bin, the sum of (f Jacobian)^2 over the `points` points
  /// of a round. `points` is their effective number, (sum of squares)^2 / sum of their squares, if few dominate.
  void refine(std::span<const double> power, double points);
  /// Edges of dimension d: bins + 1 non-decreasing numbers from 0 to 1.
  std::span<const double> edges(int d) const;

 private:
  static constexpr std::size_t cells = 1024; // equal intervals of each axis, for the search of bins

  void index(std::size_t d);
  std::size_t bin(std::size_t d, double x) const;

  int dim_;
  std::vector<double> edges_;       // dim x (bins + 1)
  std::vector<double> heights_;     // dim x bins: the density of each bin
  std::vector<std::uint8_t> first_; // dim x (cells + 1): the bin at the lower end of each cell
};

} // namespace mc
