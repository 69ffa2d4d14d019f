#include <mc/estimate/integrate/correlation.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::detail::combine_independent;
using mc::detail::Correlations;
using mc::detail::correlations;

TEST(Correlations, MatchTheReplicates) {
  const Correlations c = correlations({{1, 2, 3}, {-2, -4, -6}, {1, 0, 1}, {5, 5, 5}});
  const double expected[] = {1, -1, 0, 0, -1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(c[i], expected[i], 1e-15) << i;
}

TEST(Correlations, AreScaleInvariant) {
  for (const double size : {1e-300, 1e300}) {
    const Correlations c = correlations({{1, 2, 4}, {size, 2 * size, 4 * size}, {4 * size, 2 * size, size}});
    EXPECT_NEAR(c[1], 1, 1e-12) << size;
    EXPECT_NEAR(c[2], correlations({{1, 2, 4}, {4, 2, 1}})[1], 1e-12) << size;
  }
}

// For two independent rounds, the covariances add with the squares of their shares.
TEST(Correlations, CombineAsTheMeansDo) {
  const mc::detail::Means a = {{0, 1, 9}, {0, 2, 9}}, b = {{0, 3, 9}, {0, 0.5, 9}};
  const double share = 0.3, xx = 0.7 * 0.7 * 1 + 0.3 * 0.3 * 9, yy = 0.7 * 0.7 * 4 + 0.3 * 0.3 * 0.25;
  const double xy = 0.7 * 0.7 * 1 * 2 * 0.6 + 0.3 * 0.3 * 3 * 0.5 * -0.8;
  const Correlations c = combine_independent({1, 0.6, 0.6, 1}, a, {1, -0.8, -0.8, 1}, b, share);
  EXPECT_NEAR(c[1], xy / std::sqrt(xx * yy), 1e-15);
  EXPECT_EQ(c[1], c[2]);
  EXPECT_EQ(c[0], 1);
}

} // namespace
