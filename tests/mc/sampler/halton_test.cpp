#include <mc/sampler/halton.h>

#include "nets.h"

#include <gtest/gtest.h>

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

// Checks the documented behaviour of indices from 2^32 on.
TEST(Halton, IndicesFrom2To32On) {
  constexpr std::uint64_t beyond = std::uint64_t{1} << 32;
  const mc::Halton digits(5, mc::HaltonScramble::digits), nested(5);
  for (const std::uint32_t dim : {0u, 1u, 2u, 17u, 1023u})
    for (std::uint64_t i = 0; i < 100; ++i) {
      EXPECT_EQ(digits.bits(i, dim), digits.bits(i + beyond, dim)) << dim << " " << i;
      const std::uint64_t here = nested.bits(i, dim), there = nested.bits(i + beyond, dim);
      EXPECT_NE(here, there) << dim << " " << i;
      EXPECT_LE(std::max(here, there) - std::min(here, there), beyond) << dim << " " << i;
    }
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
