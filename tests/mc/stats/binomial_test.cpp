#include <mc/stats/binomial.h>

#include <gtest/gtest.h>

namespace {

TEST(Binomial, TailsAreExact) {
  EXPECT_NEAR(mc::binomial_tail(0, 10, 0.5), 2.0 / 1024, 1e-15);
  EXPECT_NEAR(mc::binomial_tail(9, 10, 0.5), 22.0 / 1024, 1e-15);
  EXPECT_EQ(mc::binomial_tail(5, 10, 0.5), 1);
  EXPECT_EQ(mc::binomial_tail(1, 10, 0), 0);
  EXPECT_EQ(mc::binomial_tail(0, 10, 0), 1);
}

TEST(Binomial, TailsOfFractionsLieBetweenThoseOfWholeNumbers) {
  EXPECT_LT(mc::binomial_tail(91, 1000, 0.1), mc::binomial_tail(91.5, 1000, 0.1));
  EXPECT_GT(mc::binomial_tail(92, 1000, 0.1), mc::binomial_tail(91.5, 1000, 0.1));
}

} // namespace
