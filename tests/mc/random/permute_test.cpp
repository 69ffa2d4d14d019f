#include <mc/random/permute.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace {

TEST(Permute, IsABijection) {
  for (const std::uint32_t n : {1u, 2u, 3u, 5u, 16u, 17u, 100u, 1000u, 4097u})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::vector<int> hits(n);
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t p = mc::permute(i, n, seed);
        ASSERT_LT(p, n);
        ++hits[p];
      }
      for (const int h : hits) ASSERT_EQ(h, 1) << "n = " << n << ", seed " << seed;
    }
}

TEST(Permute, StaysInRangeForLargeSizes) {
  for (const std::uint32_t n : {0x80000000u, 0x80000001u, 0xffffffffu})
    for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_LT(mc::permute(n - 1 - i * 1000, n, i), n);
}

TEST(Permute, RoundsReproduceThePermutation) {
  for (const std::uint32_t n : {1u, 2u, 7u, 16u, 17u, 1000u, 0xffffffffu})
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const mc::Permutation permutation(n, seed);
      std::uint32_t i = n / 3;
      do
        for (std::uint64_t r = 0; r < permutation.rounds(); ++r) i = permutation.round(i, permutation.key(r));
      while (i >= permutation.size());
      EXPECT_EQ(i, permutation(n / 3));
      EXPECT_EQ(i, mc::permute(n / 3, n, seed));
    }
}

// Tests the images of the first two elements over seeds against the uniform law of ordered pairs. The bound of
// chi-square is its mean plus 5 sd, alpha about 1e-6.
TEST(Permute, PairsAreUniform) {
  for (const std::uint32_t n : {3u, 4u, 7u, 16u, 23u}) {
    constexpr int seeds = 200'000;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (int s = 0; s < seeds; ++s) {
      const std::uint64_t key = mc::hash(11, s);
      ++count[{mc::permute(0, n, key), mc::permute(1, n, key)}];
    }
    const double cells = n * (n - 1.0), expected = seeds / cells;
    double chi2 = (cells - static_cast<double>(count.size())) * expected;
    for (const auto& [pair, c] : count) chi2 += (c - expected) * (c - expected) / expected;
    EXPECT_LE(chi2, cells - 1 + 5 * std::sqrt(2 * (cells - 1))) << "n = " << n;
  }
}

} // namespace
