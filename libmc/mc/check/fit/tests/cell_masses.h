#pragma once
/// Cells adapted to a pilot, and the probability that the claimed density gives each.

#include <mc/check/fit/expected/cubature.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/fit/tests/cell_tests.h>

#include <vector>

namespace mc {

struct CellMasses {
  Partition partition;
  std::vector<Cell> cells;  ///< of the partition, in its order, with no counts yet
  CubatureResult integrals; ///< of the pieces that the cells were cut into
};

/// Cells of at least 200 of the n samples each, at most 4096, and their probabilities: to 4 % of the standard deviation
/// of their counts, and to 6 % of it all together, where max_evaluations of the density suffice.
CellMasses integrate_cells(const Subject& subject, const Pilot& pilot, double n, std::size_t max_evaluations);

/// Depth of a tree whose leaves hold at least 200 samples each, at most 12.
int tree_depth(double samples);

} // namespace mc
