#include <mc/sampler/latin_hypercube.h>

#include "nets.h"

#include <gtest/gtest.h>

namespace {

TEST(LatinHypercube, OnePointPerIntervalOfEveryDimension) {
  for (const std::uint32_t n : {1u, 2u, 7u, 100u, 1021u})
    for (const std::uint32_t dim : {0u, 1u, 50u})
      for (const std::uint64_t set : {0u, 4u})
        EXPECT_EQ(test::occupancy(mc::LatinHypercube(n, 3), set * n, n, dim, n), (test::Range{1, 1}));
}

// For an additive integrand, the error has the rate N^-3/2 of one-dimensional stratification.
TEST(LatinHypercube, AdditiveIntegrandsConvergeFast) {
  const auto make = [](std::uint32_t n) { return [n](std::uint64_t seed) { return mc::LatinHypercube(n, seed); }; };
  const auto f = [](double x, double y) { return x * x + y; };
  const double ratio =
      test::rms_error(make(1024), 1024, 200, 3, 5.0 / 6, f) / test::rms_error(make(64), 64, 200, 3, 5.0 / 6, f);
  EXPECT_NEAR(std::log(ratio) / std::log(16.0), -1.5, 0.1);
}

TEST(LatinHypercube, UniformOverSeeds) {
  for (const std::uint32_t n : {1u, 5u, 0xffffffffu})
    for (const std::uint64_t i : {0ull, 1ull, 0xfffffffeull})
      EXPECT_LE(test::seed_moments([n](std::uint64_t s) { return mc::LatinHypercube(n, s); }, i, 1, 10000), 5)
          << n << " " << i;
}

TEST(LatinHypercube, RejectsNonsense) { EXPECT_THROW(mc::LatinHypercube(0), mc::Error); }

} // namespace
