#include <mc/estimate/point_set.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

// Any window of the sequence, across block borders, has the leading 32 bits of Sobol.
TEST(PointSet, SobolBlocksAreTheSequence) {
  constexpr int dim = 9;
  const mc::Sobol sobol(11);
  for (const std::uint64_t first : {0ull, 1ull, 64ull, 250ull, 4096ull, (1ull << 32) - 300}) {
    std::vector<double> u(300 * dim);
    mc::fill_points(mc::ScrambledSobol{11}, first, dim, u);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const auto bits = static_cast<std::uint32_t>(sobol.bits(first + i / dim, static_cast<std::uint32_t>(i % dim)) >> 32);
      EXPECT_EQ(u[i], (bits + 0.5) * 0x1p-32);
      EXPECT_GT(u[i], 0);
      EXPECT_LT(u[i], 1);
    }
  }
}

// The bits of two coordinates in turn, and every power of two of points one to an interval: a net in each coordinate.
TEST(PointSet, InterlacedBitsAreTwoCoordinatesInTurn) {
  const mc::Sobol sobol(11);
  for (const int dim : {1, 2, 5})
    for (const std::uint64_t first : {0ull, 3ull, 250ull, (1ull << 32) - 300}) {
      const auto n = static_cast<std::size_t>(dim);
      std::vector<double> u(300 * n);
      mc::fill_points(mc::InterlacedSobol{11}, first, dim, u);
      for (std::size_t i = 0; i < u.size(); ++i) {
        const auto bits = static_cast<std::uint64_t>(std::ldexp(u[i], 52));
        EXPECT_EQ(u[i], std::ldexp(static_cast<double>(bits) + 0.5, -52));
        const auto d = static_cast<std::uint32_t>(2 * (i % n));
        for (std::uint32_t k = 0; k < 52; ++k)
          ASSERT_EQ(bits >> (51 - k) & 1, sobol.bits(first + i / n, d + k % 2) >> (63 - k / 2) & 1) << i << " " << k;
      }
    }
  std::vector<double> u(1024);
  std::vector<int> cells(1024);
  mc::fill_points(mc::InterlacedSobol{3}, 0, 1, u);
  for (const double x : u) ++cells[static_cast<std::size_t>(1024 * x)];
  EXPECT_EQ(cells, std::vector<int>(1024, 1));
}

TEST(PointSet, DimensionsBeyondSobolAreHashed) {
  constexpr int dim = 1030;
  std::vector<double> u(2 * dim);
  mc::fill_points(mc::ScrambledSobol{5}, 7, dim, u);
  for (const std::uint32_t d : {1024u, 1029u}) EXPECT_EQ(u[dim + d], mc::coordinate<double>(mc::Sobol(5), 8, d));
}

TEST(PointSet, IndependentAndStratifiedAreTheirSamplers) {
  std::vector<double> u(3 * 50);
  mc::fill_points(mc::Independent{4}, 20, 3, u);
  EXPECT_EQ(u[3 * 7 + 2], mc::coordinate<double>(mc::Independent{4}, 27, 2));
  const mc::Stratified stratified(50, 4, 3);
  mc::fill_points(stratified, 0, 3, u);
  EXPECT_EQ(u[3 * 7 + 2], mc::coordinate<double>(stratified, 7, 2));
}

} // namespace
