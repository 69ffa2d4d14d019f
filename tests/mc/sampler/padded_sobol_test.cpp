#include <mc/sampler/padded_sobol.h>

#include "nets.h"

#include <gtest/gtest.h>

namespace {

using test::occupancy;
using test::Range;

TEST(PaddedSobol, EveryPairIsAZeroNet) {
  for (const std::uint32_t pair : {0u, 1u, 2u, 1000u})
    for (const std::uint64_t first : {0ull, 256ull, 0xffffff00ull})
      for (int m = 0; m <= 8; ++m)
        EXPECT_EQ(occupancy(mc::PaddedSobol{7}, first, 256, 2 * pair, 1u << m, 2 * pair + 1, 1u << (8 - m)),
                  (Range{1, 1}));
}

// Dimensions of different pairs are shuffled. An aligned net in (0,2) would have one of the 256 points in each of the
// 16 x 16 cells.
TEST(PaddedSobol, PairsAreShuffledAgainstEachOther) {
  EXPECT_GE(occupancy(mc::PaddedSobol{7}, 0, 256, 0, 16, 2, 16).most, 2);
  EXPECT_GE(occupancy(mc::PaddedSobol{7}, 0, 256, 1, 16, 3, 16).most, 2);
}

TEST(PaddedSobol, PairIsBothCoordinates) {
  const mc::PaddedSobol s{3};
  for (std::uint32_t i = 0; i < 1000; ++i)
    EXPECT_EQ((s.pair<float>(i, i % 5)), (mc::point<float, 2>(s, i, 2 * (i % 5))));
}

TEST(PaddedSobol, UniformOverSeeds) {
  for (const std::uint32_t d : {0u, 1u, 9u})
    for (const std::uint64_t i : {0ull, 1ull, 0xffffffffull})
      EXPECT_LE(test::seed_moments([](std::uint64_t s) { return mc::PaddedSobol{s}; }, i, d), 5);
}

} // namespace
