#include <mc/sampler/multi_jittered.h>

#include "nets.h"

#include <gtest/gtest.h>

namespace {

using test::occupancy;
using test::Range;

TEST(MultiJittered, SquaresAreGridAndLatin) {
  for (const std::uint32_t side : {1u, 2u, 5u, 20u}) {
    const std::uint32_t n = side * side;
    const mc::MultiJittered s(n, 3);
    for (const std::uint32_t dim : {0u, 6u}) {
      EXPECT_EQ(occupancy(s, n, n, dim, side, dim + 1, side), (Range{1, 1}));
      EXPECT_EQ(occupancy(s, n, n, dim, n), (Range{1, 1}));
      EXPECT_EQ(occupancy(s, n, n, dim + 1, n), (Range{1, 1}));
    }
  }
}

TEST(MultiJittered, AnyCount) {
  for (std::uint32_t n = 1; n < 130; ++n) {
    const mc::MultiJittered s(n, n);
    EXPECT_GE(std::uint64_t{s.columns()} * s.rows(), n);
    EXPECT_EQ(occupancy(s, 0, n, 1, n), (Range{1, 1})) << n;
    EXPECT_LE(occupancy(s, 0, n, 0, s.columns() * s.rows()).most, 1) << n;
  }
}

TEST(MultiJittered, UniformOverSeeds) {
  for (const std::uint32_t n : {1u, 16u, 1u << 31}) // full grids only: other counts guarantee less
    for (const std::uint64_t i : {0ull, 1ull, 0x7fffffffull})
      EXPECT_LE(test::seed_moments([n](std::uint64_t s) { return mc::MultiJittered(n, s); }, i, 2, 10000), 5)
          << n << " " << i;
}

TEST(MultiJittered, RejectsNonsense) {
  EXPECT_THROW(mc::MultiJittered(0), mc::Error);
  EXPECT_THROW(mc::MultiJittered(0xffffffffu), mc::Error);
}

} // namespace
