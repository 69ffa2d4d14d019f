#include <mc/random/hash.h>
#include <mc/sampler/owen_scramble.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

TEST(ReverseBits, IsItsOwnInverse) {
  EXPECT_EQ(mc::reverse_bits(1), 0x80000000u);
  EXPECT_EQ(mc::reverse_bits(0xf0u), 0x0f000000u);
  static_assert(mc::reverse_bits64(0xf0u) == 0x0f00000000000000u);
  for (std::uint32_t k = 0; k < 1000; ++k) {
    const auto x = static_cast<std::uint32_t>(mc::mix64(k));
    EXPECT_EQ(mc::reverse_bits(mc::reverse_bits(x)), x);
    EXPECT_EQ(mc::reverse_bits64(x) >> 32, mc::reverse_bits(x));
    EXPECT_EQ(mc::reverse_bits64(std::uint64_t{x} << 32), mc::reverse_bits(x));
  }
}

// Two numbers that agree in exactly their first k bits must do so after scrambling.
TEST(OwenScramble, PreservesElementaryIntervals) {
  for (std::uint32_t t = 0; t < 1000; ++t) {
    const auto x = static_cast<std::uint32_t>(mc::hash(1, t)), seed = static_cast<std::uint32_t>(mc::hash(2, t));
    for (int k = 0; k < 32; ++k) {
      const std::uint32_t first_difference = 0x80000000u >> k;
      const std::uint32_t y =
          (x ^ first_difference) ^ (static_cast<std::uint32_t>(mc::hash(3, t, k)) & (first_difference - 1));
      EXPECT_EQ(__builtin_clz(mc::owen_scramble(x, seed) ^ mc::owen_scramble(y, seed)), k);
    }
  }
}

// Each output bit must be 1 for half of the seeds, for any input. There are 4 x 32 proportions of 2^16 trials; 5.5 sd
// give alpha 5e-6.
TEST(OwenScramble, EveryBitIsFair) {
  for (const std::uint32_t x : {0u, 1u, 0x80000000u, 0xffffffffu}) {
    int ones[32] = {};
    constexpr std::uint32_t seeds = 1u << 16;
    for (std::uint32_t s = 0; s < seeds; ++s) {
      const std::uint32_t y = mc::owen_scramble(x, static_cast<std::uint32_t>(mc::hash(5, s)));
      for (int b = 0; b < 32; ++b) ones[b] += static_cast<int>(y >> b & 1);
    }
    for (int b = 0; b < 32; ++b) EXPECT_LE(std::abs(ones[b] - seeds / 2.0), 5.5 * 128) << x << " bit " << b;
  }
}

} // namespace
