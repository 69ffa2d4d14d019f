// Defects of estimators in published renderers, found with their own code. Comments give the value of the defect; libmc
// must not have it. mis_test.cpp tests weights over the whole range of the scalar.

#include <mc/estimate/mis.h>
#include <mc/estimate/moments.h>

#include <gtest/gtest.h>

namespace {

// D3, M11. pbrt-v4 and Mitsuba 3 in float: the two weights of the power heuristic sum to NaN or 0 below 1e-23, and to 2
// or 0 above 1e19. The balance heuristic of pbrt-v4 is correct there, but NaN for two infinities. Exact weights are 1/2
// for equal densities and 1/101 against a density ten times larger.
TEST(PeerDefects, PowerHeuristicFrom1e30To1e30) {
  for (const float p : {1e-30f, 1e-24f, 1e-23f, 1e-20f, 1.0f, 1e19f, 1.9e19f, 1e20f, 1e30f}) {
    EXPECT_EQ(mc::power_heuristic(1.0f, p, 1.0f, p), 0.5f) << p;
    EXPECT_NEAR(mc::power_heuristic(1.0f, p, 1.0f, 10 * p) * 101, 1, 1e-6) << p;
    EXPECT_NEAR(mc::balance_heuristic(1.0f, p, 1.0f, 10 * p) * 11, 1, 1e-6) << p;
  }
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(mc::power_heuristic(1.0f, inf, 1.0f, inf), 0.5f);
  EXPECT_EQ(mc::balance_heuristic(1.0f, inf, 1.0f, inf), 0.5f);
  EXPECT_EQ(mc::power_heuristic(1.0f, 0.0f, 1.0f, 0.0f), 0.0f);
}

// D15. pbrt-v4 divides the variance by the mean instead of its square for the relative variance, 0.4 for N(10, 2). An
// Estimate contains the error of its mean and leaves the ratio to the user.
TEST(PeerDefects, ErrorsAreThoseOfTheMean) {
  mc::Moments m;
  for (int i = 0; i < 1000; ++i) m.add(i % 2 ? 12 : 8);
  EXPECT_NEAR(m.variance() / (m.mean() * m.mean()), 0.04, 1e-4);
  EXPECT_NEAR(m.estimate().std_error, 2 / std::sqrt(1000.0), 1e-4);
}

// D16. pbrt-v4 counts in float, which stops at 2^24. Tests moments of 2^25 values, by merging.
TEST(PeerDefects, CountsGoBeyond2To24) {
  mc::Moments m;
  m.add(1);
  m.add(2);
  for (int i = 0; i < 24; ++i) m.merge(mc::Moments(m));
  EXPECT_EQ(m.count(), std::uint64_t{1} << 25);
  EXPECT_NEAR(m.mean(), 1.5, 1e-12);
  EXPECT_NEAR(m.variance(), 0.25, 1e-7);
}

} // namespace
