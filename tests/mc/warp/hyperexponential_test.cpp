#include <mc/warp/hyperexponential.h>

#include <gtest/gtest.h>

namespace {

using mc::Hyperexponential;

// 1 - tail(x) is the integral of the density, by Simpson's rule; its error is below 1e-9 here.
TEST(Hyperexponential, TailIsTheRestOfTheDensity) {
  const Hyperexponential<double, 3> flight({1, 2, 0.5}, {1, 0.3, 4});
  constexpr int n = 1000;
  for (const double x : {0.1, 1.0, 7.0}) {
    double integral = 0;
    for (int i = 0; i <= n; ++i) {
      const int weight = i == 0 || i == n ? 1 : 2 + 2 * (i % 2);
      integral += weight * flight.pdf(x * i / n) * x / n / 3;
    }
    EXPECT_NEAR(flight.tail(x), 1 - integral, 1e-8) << x;
  }
  EXPECT_EQ(flight.tail(0), 1);
  EXPECT_EQ(flight.pdf(-1), 0);
}

// A rate of 0 gives infinity; a weight of 0 is never chosen.
TEST(Hyperexponential, ZeroRatesAndWeights) {
  const Hyperexponential<float, 3> flight({1, 1, 0}, {2, 0, 3});
  EXPECT_TRUE(std::isfinite(flight.sample(0.49f)));
  EXPECT_EQ(flight.sample(0.75f), mc::infinity<float>);
  EXPECT_EQ(flight.sample(mc::one_minus_epsilon<float>), mc::infinity<float>);
  EXPECT_EQ(flight.sample(0), 0);
  // The last rate with a weight takes what rounding leaves of u, and not one without weight.
  const Hyperexponential<float, 4> thirds({1, 1, 1, 0}, {1, 1, 1, 1e9f});
  EXPECT_GT(thirds.sample(mc::one_minus_epsilon<float>), 10);
}

TEST(Hyperexponential, RefusesNonsense) {
  using Two = Hyperexponential<double, 2>;
  EXPECT_THROW(Two({0, 0}, {1, 1}), mc::Error);
  EXPECT_THROW(Two({1, -1}, {1, 1}), mc::Error);
  EXPECT_THROW(Two({1, 1}, {1, -1}), mc::Error);
  EXPECT_THROW(Two({1, 1}, {1, std::numeric_limits<double>::infinity()}), mc::Error);
  EXPECT_THROW(Two({1e308, 1e308}, {1, 1}), mc::Error);
}

} // namespace
