#include <mc/estimate/point_set.h>

#include <mc/core/types.h>

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
      const auto bits =
          static_cast<std::uint32_t>(sobol.bits(first + i / dim, static_cast<std::uint32_t>(i % dim)) >> 32);
      EXPECT_EQ(std::floor(std::ldexp(u[i], 32)), bits);
      EXPECT_EQ(std::ldexp(u[i], 52) - std::floor(std::ldexp(u[i], 52)), 0.5);
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

// Root mean square error of the mean of prod exp(x_d), over 64 seeds: known to 9 %.
template <class Set> double rms(int dim, std::size_t n) {
  const double truth = std::pow(std::exp(1.0) - 1, dim);
  double sum = 0;
  std::vector<double> u(static_cast<std::size_t>(dim) * n);
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    mc::fill_points(Set{seed}, 0, dim, u);
    double mean = 0;
    for (std::size_t i = 0; i < u.size(); i += static_cast<std::size_t>(dim)) {
      double product = 1;
      for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) product *= std::exp(u[i + d]);
      mean += product / static_cast<double>(n);
    }
    sum += mc::sqr(mean - truth);
  }
  return std::sqrt(sum / 64);
}
// The exponent over 6 doublings: known to sqrt(2) .09 / ln 64 = .03.
template <class Set> double rate(int dim) { return std::log(rms<Set>(dim, 4096) / rms<Set>(dim, 64)) / std::log(64.0); }

TEST(PointSet, InterlacingGainsAnOrderInOneAndTwoDimensionsOnly) {
  EXPECT_NEAR(rate<mc::ScrambledSobol>(1), -1.5, 0.1);
  EXPECT_NEAR(rate<mc::InterlacedSobol>(1), -2.45, 0.1);
  EXPECT_NEAR(rate<mc::ScrambledSobol>(2), -1.45, 0.1);
  EXPECT_LE(rate<mc::InterlacedSobol>(2), -2);
  EXPECT_NEAR(rms<mc::InterlacedSobol>(5, 4096) / rms<mc::ScrambledSobol>(5, 4096), 1, 0.5);
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
