#include <mc/sampler/halton.h>

#include <mc/stats/chi_square.h>

#include "nets.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using test::occupancy;
using test::Range;
constexpr mc::HaltonScramble both[] = {mc::HaltonScramble::digits, mc::HaltonScramble::owen};

TEST(Halton, BasesArePrimes) {
  EXPECT_EQ(mc::Halton::base(0), 2u);
  EXPECT_EQ(mc::Halton::base(4), 11u);
  EXPECT_EQ(mc::Halton::base(1023), 8161u);
}

// The digits of 11 in base 2 are 1011, in base 3 they are 102.
TEST(Halton, RadicalInverse_MirrorsDigits) {
  EXPECT_EQ(mc::Halton::radical_inverse(0, 5), 0);
  EXPECT_EQ(mc::Halton::radical_inverse(11, 0), 13.0 / 16);
  EXPECT_EQ(mc::Halton::radical_inverse(11, 1), 19.0 / 27);
  for (const std::uint32_t d : {0u, 1u, 1023u}) EXPECT_LT(mc::Halton::radical_inverse(0xffffffffu, d), 1);
}

TEST(Halton, AlignedBlocksFillEveryInterval) {
  for (const auto scramble : both)
    for (const std::uint32_t d : {0u, 1u, 2u, 5u, 1023u}) {
      const std::uint64_t b = mc::Halton::base(d);
      for (std::uint64_t n = b; n < 10000; n *= b)
        for (const std::uint64_t block : {0u, 3u})
          EXPECT_EQ(occupancy(mc::Halton(5, scramble), block * n, n, d, n), (Range{1, 1})) << "base " << b;
    }
}

TEST(Halton, FirstTwoDimensionsFillBoxes) {
  for (const auto scramble : both)
    EXPECT_EQ(occupancy(mc::Halton(2, scramble), 2592, 1296, 0, 16, 1, 81), (Range{1, 1}));
}

TEST(Halton, UniformOverSeeds) {
  for (const auto scramble : both)
    for (const std::uint32_t d : {0u, 1u, 30u, 1022u, 1023u, 3000u})
      for (const std::uint64_t i : {0ull, 1ull, 0xffffffffull})
        EXPECT_LE(test::seed_moments([&](std::uint64_t s) { return mc::Halton(s, scramble); }, i, d, 4000), 5)
            << d << " " << i;
}

TEST(Halton, DimensionsBeyondTheLastDoNotWrap) {
  const mc::Halton s(1);
  for (std::uint32_t i = 0; i < 16; ++i) EXPECT_NE(s.bits(i, 1024), s.bits(i, 0));
}

// Checks the documented behaviour of indices from the largest power of the base on.
TEST(Halton, IndicesBeyondTheLargestPower) {
  const mc::Halton digits(5, mc::HaltonScramble::digits), nested(5);
  for (const std::uint32_t dim : {0u, 1u, 2u, 17u, 1023u}) {
    std::uint64_t power = 1;
    while (power * mc::Halton::base(dim) <= std::uint64_t{1} << 32) power *= mc::Halton::base(dim);
    const std::uint64_t length = ~std::uint64_t{0} / power;
    for (std::uint64_t i = 0; i < 100; ++i) {
      EXPECT_EQ(digits.bits(i, dim), digits.bits(i + power, dim)) << dim << " " << i;
      const std::uint64_t here = nested.bits(i, dim), there = nested.bits(i + power, dim);
      EXPECT_NE(here, there) << dim << " " << i;
      EXPECT_LE(std::max(here, there) - std::min(here, there), length) << dim << " " << i;
    }
  }
}

// In base 3, indices 1 and 4 have the same first digit and different second ones. Owen's scrambling keeps this, makes
// the pair of second digits uniform among the 6 pairs of different ones, and the third digits independent.
TEST(Halton, PairsOfPointsFollowNestedScrambling) {
  constexpr std::uint64_t seeds = 54'000;
  std::array<double, 81> counts{};
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const mc::Halton s(seed);
    const std::size_t a = test::interval(s.bits(1, 1), 27), b = test::interval(s.bits(4, 1), 27);
    EXPECT_EQ(a / 9, b / 9);
    ++counts[a / 3 % 3 * 27 + b / 3 % 3 * 9 + a % 3 * 3 + b % 3];
  }
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = i / 27 == i / 9 % 3 ? 0 : double(seeds) / 54;
    if (expected == 0) EXPECT_EQ(counts[i], 0);
    else statistic += mc::sqr(counts[i] - expected) / expected;
  }
  EXPECT_GE(mc::chi_square_tail(statistic, 53), 1e-4);
}

// For a smooth integrand, 36 times the points must reduce the error by far more than the factor 6 of independent
// points.
TEST(Halton, ConvergesFasterThanIndependent) {
  const auto f = [](double x, double y) { return std::exp(x) * std::exp(y); };
  const double exact = mc::sqr(std::exp(1.0) - 1);
  for (const auto scramble : both) {
    const auto make = [&](std::uint64_t s) { return mc::Halton(s, scramble); };
    EXPECT_LE(test::rms_error(make, 7776, 30, 0, exact, f), test::rms_error(make, 216, 30, 0, exact, f) / 15);
  }
}

} // namespace
