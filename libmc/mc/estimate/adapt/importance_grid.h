#pragma once
/// Importance sampling learned from the integrand, one dimension at a time.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// A separable map of the unit cube onto itself, piecewise linear in each dimension: `bins` intervals of equal
/// probability whose edges move to where the integrand is large. The number of bins is a power of two, so that their
/// edges are edges of elementary intervals of a Sobol' sequence: the jumps of the density cost it nothing.
///   map    : u in [0,1)^dim -> x in [0,1)^dim, in place, with the Jacobian |dx/du| = 1 / density
///   refine : makes the density in each dimension proportional to the root of the mean of (f / density)^2 over the
///            others, which is the best separable step, with more edges at its jumps. Bins widen step by step away from
///            narrow ones: no point may have met the flanks of a peak. A tenth of the probability stays uniform, so no
///            region is lost and the Jacobian stays below 12.5 in each dimension. Of few points only the coarse shape
///            is learned: at least 64 stand behind what is taken for the power of a bin
///   Source : [Lepage78]
class ImportanceGrid {
 public:
  static constexpr std::size_t bins = 128;

  explicit ImportanceGrid(int dim);
  /// With the edges of each dimension, one after the other.
  ///   throws : Error unless there are bins + 1 for each, from 0 to 1 without falling
  explicit ImportanceGrid(std::vector<double> edges);

  int dim() const { return dim_; }
  /// Maps one point in place, and returns the Jacobian.
  double map(std::span<double> u) const;
  /// The density of the points that map() returns, at x in [0,1)^dim: the inverse of its Jacobian.
  double density(std::span<const double> x) const;
  /// Maps one point x back to u, in place, and returns the density at x.
  double invert(std::span<double> x) const;
  /// `power` holds, for each dimension and bin, the sum of (f Jacobian)^2 over the `points` of a round.
  void refine(std::span<const double> power, std::uint64_t points);
  /// The edges of one dimension: bins + 1 increasing numbers from 0 to 1.
  std::span<const double> edges(int d) const;

 private:
  int dim_;
  std::vector<double> edges_; // dim x (bins + 1)
};

} // namespace mc
