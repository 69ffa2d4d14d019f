#include <mc/check/fit/pooled_cells.h>

#include <gtest/gtest.h>

namespace {

std::vector<mc::Cell> cells_of(const std::vector<double>& p, double n) {
  std::vector<mc::Cell> cells;
  for (const double x : p) {
    mc::Cell c;
    c.p = x;
    c.observed = c.squares = n * x;
    cells.push_back(c);
  }
  return cells;
}

TEST(PooledCells, CellsOfFewSamples_JoinTheirNeighbours) {
  const mc::PooledCells pooled = mc::pool(cells_of({0.5, 0.02, 0.02, 0.04, 0.4, 0.02}, 100));
  ASSERT_EQ(pooled.cells.size(), 3u);
  EXPECT_DOUBLE_EQ(pooled.cells[0].p, 0.5);
  EXPECT_DOUBLE_EQ(pooled.cells[1].p, 0.08);
  EXPECT_DOUBLE_EQ(pooled.cells[2].p, 0.42);
  EXPECT_DOUBLE_EQ(pooled.observed[2], 58);
  EXPECT_TRUE(pooled.is_testable());
}

TEST(PooledCells, WrongTotal_IsNormalised) {
  const mc::PooledCells pooled = mc::pool(cells_of({0.5, 1}, 100));
  EXPECT_DOUBLE_EQ(pooled.cells[0].p, 1 / 3.0);
  EXPECT_DOUBLE_EQ(pooled.dispersion(), 1);
}

TEST(PooledCells, VarianceOfACell_HasBothParts) {
  std::vector<mc::Cell> cells = cells_of({0.25, 0.75}, 100);
  for (mc::Cell& c : cells) c.squares *= 2;
  cells[0].variance = 1e-4;
  const mc::PooledCells pooled = mc::pool(cells);
  EXPECT_DOUBLE_EQ(pooled.variance_of(pooled.cells[0]), 2 * 25 + 100 * 100 * 1e-4);
  EXPECT_DOUBLE_EQ(pooled.variance_of(pooled.cells[1]), 2 * 75);
}

TEST(PooledCells, OneCell_AllowsNoTest) { EXPECT_FALSE(mc::pool(cells_of({1}, 100)).is_testable()); }

TEST(PooledCells, FactorAcrossCells_FollowsTheFormula) {
  EXPECT_DOUBLE_EQ(mc::factor_across_cells(1), 1 / std::sqrt(1 - 1 / 12.0));
  EXPECT_DOUBLE_EQ(mc::factor_across_cells(2), 1 / (1 - 1 / 6.0));
}

} // namespace
