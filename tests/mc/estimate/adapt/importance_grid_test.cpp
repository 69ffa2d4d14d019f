#include <mc/core/error.h>
#include <mc/estimate/adapt/importance_grid.h>
#include <mc/sampler/independent.h>

#include <gtest/gtest.h>

#include <array>

namespace {

using mc::ImportanceGrid;

// Refines a one-dimensional grid on f at the midpoints of 64 equal parts of each bin.
template <class F> ImportanceGrid learned(F&& f, int rounds) {
  ImportanceGrid grid(1);
  for (int k = 0; k < rounds; ++k) {
    std::vector<double> power(ImportanceGrid::bins);
    for (std::size_t i = 0; i < 64 * ImportanceGrid::bins; ++i) {
      std::array<double, 1> u = {(static_cast<double>(i) + 0.5) / (64 * ImportanceGrid::bins)};
      const auto bin = static_cast<std::size_t>(u[0] * ImportanceGrid::bins);
      const double jacobian = grid.map(u);
      power[bin] += std::pow(f(u[0]) * jacobian, 2);
    }
    grid.refine(power, 64 * ImportanceGrid::bins);
  }
  return grid;
}

TEST(ImportanceGrid, DensityIsTheInverseOfTheJacobian) {
  const ImportanceGrid grid = learned([](double x) { return 1 / (1e-4 + mc::sqr(x - 0.3)); }, 4);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    std::array<double, 1> u = {mc::coordinate<double>(mc::Independent{2}, i, 0)};
    const double jacobian = grid.map(u);
    EXPECT_NEAR(grid.density(u) * jacobian, 1, 1e-9);
  }
  EXPECT_GT(grid.density(std::array{0.0}), 0);
  EXPECT_GT(grid.density(std::array{1 - 0x1p-53}), 0);
}

TEST(ImportanceGrid, StartsAsTheIdentity) {
  const ImportanceGrid grid(2);
  std::array u = {0.3, 0.9999};
  EXPECT_DOUBLE_EQ(grid.map(u), 1);
  EXPECT_DOUBLE_EQ(u[0], 0.3);
}

TEST(ImportanceGrid, MapsTheCubeOntoItself) {
  const ImportanceGrid grid = learned([](double x) { return std::exp(-200 * std::abs(x - 0.3)); }, 4);
  EXPECT_EQ(grid.edges(0).front(), 0);
  EXPECT_EQ(grid.edges(0).back(), 1);
  for (std::size_t i = 0; i < ImportanceGrid::bins; ++i) EXPECT_LT(grid.edges(0)[i], grid.edges(0)[i + 1]);
  for (const double v : {0.0, 0x1p-40, 0.5, std::nextafter(1.0, 0.0)}) {
    std::array u = {v};
    const double jacobian = grid.map(u);
    EXPECT_GE(u[0], 0);
    EXPECT_LT(u[0], 1);
    EXPECT_GT(jacobian, 0);
    EXPECT_LE(jacobian, 20.001); // a tenth of the probability is uniform, and at most a quarter more bins are added
  }
}

TEST(ImportanceGrid, RefineConcentratesBinsAtLargeValues) {
  const ImportanceGrid grid = learned([](double x) { return x < 0.01 ? 1.0 : 0.0; }, 6);
  std::size_t inside = 0;
  for (const double e : grid.edges(0)) inside += e <= 0.01;
  EXPECT_GE(inside, ImportanceGrid::bins / 2);
}

// Checks the gradual growth of bins, because the flanks of a peak may contain no point. Neighbouring bins differ by at
// most 8^3, the first power of 8 for which these peaks need at most a quarter more bins. Redistribution over 128 bins
// adds a factor 1.25. Directly beside the peak the density is far above the uniform tenth.
TEST(ImportanceGrid, BinsWidenStepwiseAwayFromPeaks) {
  for (const double width : {1e-2, 1e-3}) {
    const ImportanceGrid grid = learned([width](double x) { return std::abs(x - 0.4) < width ? 1.0 : 0.0; }, 12);
    const std::span<const double> e = grid.edges(0);
    for (std::size_t i = 1; i < ImportanceGrid::bins; ++i) {
      const double ratio = (e[i + 1] - e[i]) / (e[i] - e[i - 1]);
      EXPECT_LE(std::max(ratio, 1 / ratio), 1.25 * 512) << width;
    }
    EXPECT_GT(grid.density(std::array{0.4 + 1.05 * width}), 20 * 0.1) << width;
    std::size_t inside = 0;
    for (const double edge : e) inside += std::abs(edge - 0.4) <= width;
    EXPECT_GE(inside, ImportanceGrid::bins / 2) << width;
  }
}

// Edges near 0 keep their relative precision.
TEST(ImportanceGrid, ResolvesAPoleAtZero) {
  const ImportanceGrid grid = learned([](double x) { return std::pow(x, -0.97); }, 40);
  const std::span<const double> e = grid.edges(0);
  EXPECT_LT(e[1], 1e-12);
  for (std::size_t i = 0; i < ImportanceGrid::bins; ++i) EXPECT_LT(e[i], e[i + 1]) << i;
}

// For a constant, only noise could be learned. Tests one round of 128 to 8192 random points, with 8 behind each bin. A
// count of 8 has a relative deviation of .35 and its root of .18. The worst of 128 bins deviates by 3 of these. Without
// pooling, bins without a point would reach 10.
TEST(ImportanceGrid, Refine_FewPoints_DoesNotFitNoise) {
  for (const std::size_t points : {128u, 512u, 2048u, 8192u}) {
    const mc::Independent sampler{points};
    ImportanceGrid grid(1);
    std::vector<double> power(ImportanceGrid::bins);
    for (std::size_t i = 0; i < points; ++i) {
      std::array u = {mc::coordinate<double>(sampler, i, 0)};
      power[static_cast<std::size_t>(u[0] * ImportanceGrid::bins)] += 1;
    }
    grid.refine(power, points);
    for (std::size_t i = 0; i < ImportanceGrid::bins; ++i) {
      const double jacobian = ImportanceGrid::bins * (grid.edges(0)[i + 1] - grid.edges(0)[i]);
      EXPECT_GE(jacobian, 1 / 1.54) << points;
      EXPECT_LE(jacobian, 1.54) << points;
    }
  }
}

TEST(ImportanceGrid, Refine_AllZero_KeepsTheEdges) {
  const ImportanceGrid grid = learned([](double) { return 0.0; }, 2);
  EXPECT_DOUBLE_EQ(grid.edges(0)[64], 64.0 / ImportanceGrid::bins);
}

TEST(ImportanceGrid, RefusesNoDimensions) { EXPECT_THROW(ImportanceGrid(0), mc::Error); }

} // namespace
