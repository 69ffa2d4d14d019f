#pragma once
/// Every statistical test that can be made of counts in cells, under one family-wise alpha.

#include <mc/check/report/report.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mc {

/// A bin with the probability that the claimed density gives it, and what was counted there.
struct Cell {
  double p = 0;
  double variance = 0;              ///< of p, where it was itself estimated
  double observed = 0, squares = 0; ///< sums of the weights of the samples, nearly all 1, and of their squares
  std::array<double, 3> rank_lo{}, rank_hi{1, 1, 1}; ///< the cell's extent in the ranks of a pilot sample, per axis
};

inline void count_in(Cell& cell, double weight) {
  cell.observed += weight;
  cell.squares += weight * weight;
}

struct CellTests {
  std::vector<Check> checks;
  double detectable = 0, detectable_cell = 0; ///< see Report
};

/// Tests counts against probabilities, given their sum (atoms are cells of their own, at the end). Spends the shares
/// of alpha_shares.h.
///   chi-square : the cells form a binary tree in their order; at each node the split of its count between its halves
///                is binomial and independent of all other nodes, so the levels give independent chi-squares, each
///                sensitive to errors of its own size
///   tails      : per axis, the mean of ln r and ln(1 - r) over the ranks r of the samples, a score with two degrees of
///                freedom: powerful against wrong exponents, roughness, rotations and shifts
///   KS         : along each axis in turn, on the cells (conservative)
///   cells      : exact binomial tails of single cells and of tree nodes, the smallest p of all
/// The variance of the probabilities counts like that of the samples, so an estimated probability makes a test weaker,
/// never wrong.
///   dim : axes with ranks, 0 to 3;  cells expecting less than 8 are pooled with their neighbours in order
CellTests test_cells(const std::vector<Cell>& cells, int dim, double alpha, const std::vector<Axis>& named = {});

} // namespace mc
