#pragma once
/// The statistical tests of counts in cells, under one family-wise alpha.

#include <mc/check/report/report.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mc {

/// A bin with its probability under the claimed density and its counts.
struct Cell {
  double p = 0;
  double variance = 0;              ///< variance of p, if p is an estimate
  double observed = 0, squares = 0; ///< sums of the weights of the samples (nearly all 1) and of their squares
  std::array<double, 3> rank_lo{}, rank_hi{1, 1, 1}; ///< extent of the cell in ranks of the pilot, per axis
};

/// Adds a sample to a cell.
inline void count_in(Cell& cell, double weight) {
  cell.observed += weight;
  cell.squares += weight * weight;
}

/// Results of test_cells.
struct CellTests {
  std::vector<Check> checks;
  double detectable = 0, detectable_cell = 0; ///< as in Report
};

/// Tests counts against probabilities, given the sum of the counts. Atoms are cells of their own, at the end. Spends
/// the shares of alpha_shares.h.
///   chi-square  : the cells form a binary tree in their order. At each node the left half of the count is binomial and
///                 independent of all other nodes. The levels therefore give independent chi-squares, each sensitive to
///                 errors of its own scale.
///   tails       : per axis, the means of ln r and ln(1 - r) over the ranks r of the samples, a score with two degrees
///                 of freedom. Powerful against wrong exponents, roughness, rotations and shifts.
///   KS          : Kolmogorov-Smirnov along each axis, on the cells (conservative).
///   correlation : per pair of axes, the rank correlation.
///   cells       : exact binomial tails of single cells and of tree nodes; the smallest p of all.
/// The variance of the probabilities adds to the variance of the counts. An estimated probability thus makes a test
/// weaker, but never wrong.
///   dim : number of axes with ranks, 0 to 3. Cells with fewer than 8 expected samples are pooled with their neighbours
///         in order.
CellTests test_cells(const std::vector<Cell>& cells, int dim, double alpha, const std::vector<Axis>& named = {});

} // namespace mc
