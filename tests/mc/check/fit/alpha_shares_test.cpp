#include <mc/check/fit/alpha_shares.h>

#include <gtest/gtest.h>

namespace {

TEST(AlphaShares, SumToOne) {
  double discrete = 0, one = 0, more = 0;
  for (const mc::AlphaShare& s : mc::alpha_shares) {
    discrete += s.discrete;
    one += s.one_axis;
    more += s.more_axes;
  }
  EXPECT_LE(discrete, 1);
  EXPECT_NEAR(one, 1, 1e-12);
  EXPECT_NEAR(more, 1, 1e-12);
}

TEST(AlphaShares, LookUp_ByTestAndDimension) {
  EXPECT_EQ(mc::alpha_share(mc::FitTest::ks, 0), 0);
  EXPECT_EQ(mc::alpha_share(mc::FitTest::correlation, 1), 0);
  EXPECT_EQ(mc::alpha_share(mc::FitTest::correlation, 3), mc::alpha_share(mc::FitTest::correlation, 2));
  EXPECT_GT(mc::alpha_share(mc::FitTest::correlation, 3), 0);
}

} // namespace
