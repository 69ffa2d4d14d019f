#include <mc/random/hash.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <unordered_set>

namespace {

TEST(Hash, IsSplitmix64) {
  // First outputs of the reference code of splitmix64 from state 0.
  EXPECT_EQ(mc::hash(0), 0xe220a8397b1dcdafULL);
  EXPECT_EQ(mc::hash(0x9e3779b97f4a7c15ULL), 0x6e789e6aa1b965f4ULL);
}

TEST(Hash, OrderOfPartsMatters) {
  EXPECT_NE(mc::hash(1, 2), mc::hash(2, 1));
  EXPECT_NE(mc::hash(1, 2), mc::hash(1, 2, 0));
}

TEST(Hash, NoCollisionsOnAGrid) {
  std::unordered_set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 256; ++i)
    for (std::uint64_t j = 0; j < 256; ++j) seen.insert(mc::hash(7, i, j));
  EXPECT_EQ(seen.size(), 65536u); // 2^31 pairs in 2^64 values: a collision by chance has probability 1e-10
}

// Checks that each output bit flips with probability 1/2 if an input bit flips. There are 128 x 64 proportions of 4096
// trials with sd 2^-7. The largest deviation exceeds 6 sd with probability 2e-5.
TEST(Hash, Avalanche) {
  constexpr int trials = 4096;
  double worst = 0;
  for (int part = 0; part < 2; ++part)
    for (int in = 0; in < 64; ++in) {
      int flips[64] = {};
      for (std::uint64_t t = 0; t < trials; ++t) {
        const std::uint64_t flip = std::uint64_t{1} << in;
        const std::uint64_t d =
            mc::hash(t, 3 * t) ^ (part == 0 ? mc::hash(t ^ flip, 3 * t) : mc::hash(t, (3 * t) ^ flip));
        for (int out = 0; out < 64; ++out) flips[out] += static_cast<int>(d >> out & 1);
      }
      for (const int f : flips) worst = std::max(worst, std::abs(f / double(trials) - 0.5));
    }
  EXPECT_LE(worst, 6.0 / 128);
}

} // namespace
