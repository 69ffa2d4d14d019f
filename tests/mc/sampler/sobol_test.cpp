#include <mc/sampler/sobol.h>

#include "nets.h"

#include <boost/random/sobol.hpp>
#include <gtest/gtest.h>

namespace {

using test::occupancy;
using test::Range;

// Boost generates the sequence in Gray code order, which contains the same points.
TEST(Sobol, PointsAreThoseOfBoost) {
  constexpr std::uint32_t dims = 1024;
  boost::random::sobol_engine<std::uint32_t, 32> engine(dims);
  const mc::Sobol sobol;
  for (std::uint32_t i = 1; i < 300; ++i) // Boost omits the origin
    for (std::uint32_t d = 0; d < dims; ++d)
      ASSERT_EQ(engine(), sobol.unscrambled(i ^ (i >> 1), d)) << "point " << i << ", dim " << d;
}

TEST(Sobol, EveryDimensionIsANetInBase2) {
  for (const std::uint32_t d : {0u, 1u, 2u, 17u, 500u, 1023u})
    for (const std::uint64_t first : {0ull, 1024ull, 0xfffffc00ull})
      EXPECT_EQ(occupancy(mc::Sobol(3), first, 1024, d, 1024), (Range{1, 1}));
}

TEST(Sobol, FirstTwoDimensionsAreAZeroNet) {
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    for (int m = 0; m <= 10; ++m)
      EXPECT_EQ(occupancy(mc::Sobol(seed), 4096, 1024, 0, 1u << m, 1, 1u << (10 - m)), (Range{1, 1}))
          << "2^" << m << " columns";
}

// [JoeKuo08] optimise the quality parameter t of pairs of dimensions. t = 4 for all pairs of the first eight with 2^10
// points.
TEST(Sobol, PairsOfDimensionsAreNets) {
  for (std::uint32_t a = 0; a < 8; ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      for (int m = 0; m <= 6; ++m)
        EXPECT_EQ(occupancy(mc::Sobol(1), 0, 1024, a, 1u << m, b, 1u << (6 - m)), (Range{16, 16})) << a << " " << b;
}

// Each point is uniform over seeds: 15 moments at 5 sd each, alpha below 1e-5.
TEST(Sobol, UniformOverSeeds) {
  const auto make = [](std::uint64_t seed) { return mc::Sobol(seed); };
  for (const std::uint64_t i : {0ull, 1ull, 0xffffffffull})
    for (const std::uint32_t d : {0u, 5u, 1022u, 1023u, 5000u})
      EXPECT_LE(test::seed_moments(make, i, d), 5) << i << " " << d;
}

TEST(Sobol, DimensionsBeyondTheLastDoNotWrap) {
  const mc::Sobol s(1);
  for (std::uint32_t d = 1024; d < 1100; ++d)
    for (std::uint32_t i = 0; i < 16; ++i) EXPECT_NE(s.bits(i, d), s.bits(i, d - 1024));
}

// Smooth integrands converge with slope -3/2, so 16 times the points give 1/64 of the error. The bound allows a factor
// 2.
TEST(Sobol, SmoothIntegrandsConvergeFasterThanOneOverN) {
  const auto make = [](std::uint64_t seed) { return mc::Sobol(seed); };
  const auto f = [](double x, double y) { return std::exp(x) * std::exp(y); };
  const double exact = mc::sqr(std::exp(1.0) - 1);
  EXPECT_LE(test::rms_error(make, 4096, 60, 0, exact, f), test::rms_error(make, 256, 60, 0, exact, f) / 32);
}

TEST(Sobol, FillIsBitEqual) {
  const mc::Sobol s(9);
  for (const std::uint32_t d : {0u, 3u, 1023u, 2000u})
    for (const std::uint64_t first : {0ull, 5ull, 250ull, 0xffffff00ull}) {
      std::vector<float> x(200);
      std::vector<double> y(200);
      s.fill<float>(first, d, x);
      s.fill<double>(first, d, y);
      for (std::uint64_t i = 0; i < 200; ++i) {
        ASSERT_EQ(x[i], mc::coordinate<float>(s, first + i, d));
        ASSERT_EQ(y[i], mc::coordinate<double>(s, first + i, d));
      }
    }
}

} // namespace
