#pragma once
/// Counts of samples in cells, pooled until each cell expects enough samples.

#include <mc/check/subject/axis.h>

#include <vector>

namespace mc {

/// A bin with its probability under the claimed density and its counts.
struct Cell {
  double p = 0;
  double variance = 0;              ///< variance of p, if p is an estimate
  double observed = 0, squares = 0; ///< sums of the weights of the samples (nearly all 1) and of their squares
  PerAxis<double> rank_lo{}, rank_hi = unit_corner; ///< extent of the cell in ranks of the pilot, per axis
};

/// Adds a sample to a cell.
inline void count_in(Cell& cell, double weight) {
  cell.observed += weight;
  cell.squares += weight * weight;
}

/// Cells with at least 8 expected samples each, given the sum of the samples.
struct PooledCells {
  std::vector<Cell> cells;
  double n = 0;                                                   ///< sum of the counts
  std::vector<double> p{0}, variance{0}, observed{0}, squares{0}; ///< prefix sums

  /// Returns the variance of the sum of the weights in the cells [lo, hi), divided by its expectation.
  double dispersion(std::size_t lo, std::size_t hi) const {
    const double count = observed[hi] - observed[lo];
    return count > 0 ? (squares[hi] - squares[lo]) / count : 1.0;
  }
  /// The same for all cells.
  double dispersion() const { return dispersion(0, cells.size()); }
  /// Returns the variance of a cell's count: of the count itself, and of its estimated probability.
  double variance_of(const Cell& cell) const { return n * dispersion() * cell.p + n * n * cell.variance; }
  /// Returns whether the counts allow a test: two cells or more, and a sample.
  bool is_testable() const { return cells.size() >= 2 && n > 0; }
};

/// Joins cells with fewer than 8 expected samples with their neighbours in order, and normalises the probabilities.
/// Atoms are cells of their own, at the end.
PooledCells pool(const std::vector<Cell>& cells);

/// Returns the factor of the detectable size of errors that do not follow the cells. Their patches, or their region,
/// have the probability of four cells and cross the borders of cells. Cells at random offsets over patches w cells wide
/// retain 1 - 1 / (3 w) of the square of a random sign along each axis.
double factor_across_cells(int dim);

} // namespace mc
