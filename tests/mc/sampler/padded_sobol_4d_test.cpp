#include <mc/sampler/padded_sobol_4d.h>

#include "nets.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace {

using test::occupancy;
using test::Range;

// (3,m,4)-net: of 2^8 points, every elementary box of volume 2^-5 contains exactly 2^3, for any shape of the box.
TEST(PaddedSobol4D, EveryGroupIsANet) {
  for (const std::uint32_t group : {0u, 1u, 1000u})
    for (const std::uint64_t first : {0ull, 0xffffff00ull}) {
      const mc::PaddedSobol4D s(7);
      int shapes = 0;
      for (int a = 0; a <= 5; ++a)
        for (int b = 0; a + b <= 5; ++b)
          for (int c = 0; a + b + c <= 5; ++c, ++shapes) {
            const std::array<int, 4> cuts = {a, b, c, 5 - a - b - c};
            std::array<int, 32> hits{};
            for (std::uint64_t i = 0; i < 256; ++i) {
              std::size_t box = 0;
              for (std::uint32_t d = 0; d < 4; ++d)
                box = (box << cuts[d]) | test::interval(s.bits(first + i, 4 * group + d), std::uint64_t{1} << cuts[d]);
              ++hits[box];
            }
            for (const int h : hits) ASSERT_EQ(h, 8) << a << b << c << " group " << group;
          }
      EXPECT_EQ(shapes, 56);
    }
}

TEST(PaddedSobol4D, FirstPairOfAGroupIsAZeroNet) {
  for (int m = 0; m <= 8; ++m)
    EXPECT_EQ(occupancy(mc::PaddedSobol4D(7), 256, 256, 8, 1u << m, 9, 1u << (8 - m)), (Range{1, 1}));
}

// An aligned net over two groups would have one of the 256 points in each of the 16 x 16 cells.
TEST(PaddedSobol4D, GroupsAreShuffledAgainstEachOther) {
  EXPECT_GE(occupancy(mc::PaddedSobol4D(7), 0, 256, 0, 16, 4, 16).most, 2);
  EXPECT_GE(occupancy(mc::PaddedSobol4D(7), 0, 256, 1, 16, 5, 16).most, 2);
}

TEST(PaddedSobol4D, PointsDoNotRepeat) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 1000; ++i)
    for (std::uint32_t d = 0; d < 8; ++d)
      EXPECT_TRUE(seen.insert(mc::PaddedSobol4D(1).bits(i, d)).second) << i << ' ' << d;
}

// A product over four variables converges with slope -3/2, so 16 times the points give 1/64 of the error. The bound
// allows a factor 2. Padded pairs would not stratify the interaction of all four variables.
TEST(PaddedSobol4D, FourVariablesThatInteractConverge) {
  const double exact = mc::sqr(mc::sqr(std::exp(1.0) - 1));
  const auto rms = [&](std::uint32_t n) {
    double squares = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const mc::PaddedSobol4D s(mc::hash(5, seed));
      double sum = 0;
      for (std::uint32_t i = 0; i < n; ++i) sum += std::exp(mc::point<double, 4>(s, i).sum());
      squares += mc::sqr(sum / n - exact);
    }
    return std::sqrt(squares / 40);
  };
  EXPECT_LE(rms(4096), rms(256) / 32);
}

TEST(PaddedSobol4D, UniformOverSeeds) {
  for (const std::uint32_t d : {0u, 2u, 3u, 9u})
    for (const std::uint64_t i : {0ull, 1ull, 0xffffffffull})
      EXPECT_LE(test::seed_moments([](std::uint64_t s) { return mc::PaddedSobol4D(s); }, i, d), 5);
}

} // namespace
