#include <mc/sampler/lattice.h>

#include "nets.h"

#include <gtest/gtest.h>

namespace {

// Differences of points cancel the shift and form a lattice. After subtraction of point 0, the first 2^k points are
// multiples of 2^-k.
TEST(Lattice, LeadingPointsAreAShiftedGridInEveryDimension) {
  const mc::Lattice s(3);
  for (std::uint32_t d = 0; d < mc::Lattice::dimensions; ++d) {
    std::vector<int> hits(1024);
    for (std::uint32_t i = 0; i < 1024; ++i) {
      const std::uint64_t x = s.bits(i, d) - s.bits(0, d);
      EXPECT_EQ(x << 10, 0u);
      ++hits[x >> 54];
    }
    for (const int h : hits) EXPECT_EQ(h, 1);
  }
}

TEST(Lattice, NoTwoDimensionsCoincide) {
  auto z = mc::Lattice::generator;
  std::sort(z.begin(), z.end());
  EXPECT_EQ(std::adjacent_find(z.begin(), z.end()), z.end());
  for (const std::uint32_t x : z) EXPECT_EQ(x % 2, 1u);
}

// Mean of products of B2 kernels over pairs of dimensions, 0 for a perfect rule. For random generating vectors, the
// error is near the error of independent points. The bound is a tenth of that, for the worst pair of the first eight
// dimensions.
TEST(Lattice, PairsOfDimensionsAreEven) {
  const auto f = [](double x, double y) { return (x * x - x + 1.0 / 6) * (y * y - y + 1.0 / 6); };
  const auto make = [](std::uint64_t seed) { return mc::Lattice(seed); };
  const double independent = (1.0 / 180) / std::sqrt(4096.0);
  for (std::uint32_t d = 0; d < 7; ++d) EXPECT_LE(test::rms_error(make, 4096, 10, d, 0, f), independent / 10) << d;
}

TEST(Lattice, UniformOverSeeds) {
  for (const std::uint32_t d : {0u, 1u, 31u, 500u})
    for (const std::uint64_t i : {0ull, 1ull, 0xffffffffull})
      EXPECT_LE(test::seed_moments([](std::uint64_t s) { return mc::Lattice(s); }, i, d), 5);
}

} // namespace
