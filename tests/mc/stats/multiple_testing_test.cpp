#include <mc/stats/multiple_testing.h>

#include <gtest/gtest.h>

namespace {

TEST(Sidak, AdjustsAndKeepsTinyValues) {
  EXPECT_DOUBLE_EQ(mc::sidak(0.01, 1), 0.01);
  EXPECT_NEAR(mc::sidak(0.01, 10), 1 - std::pow(0.99, 10), 1e-15);
  EXPECT_NEAR(mc::sidak(1e-300, 1000) / 1e-297, 1, 1e-12);
  EXPECT_EQ(mc::sidak(1, 5), 1);
  EXPECT_EQ(mc::sidak(0, 5), 0);
}

TEST(Sidak, SharesAreLevelsInverted) {
  for (const double share : {0.01, 0.25, 1.0})
    for (const double alpha : {1e-6, 0.01, 0.5})
      EXPECT_NEAR(mc::sidak_share(mc::sidak_level(alpha, share), share), alpha, 1e-14);
  EXPECT_NEAR(mc::sidak_share(0.003, 0.2), mc::sidak(0.003, 5), 1e-15);
}

TEST(Holm, StepsDown) {
  const std::vector<double> adjusted = mc::holm({0.01, 0.04, 0.03, 0.005});
  EXPECT_NEAR(adjusted[3], 0.02, 1e-15);
  EXPECT_NEAR(adjusted[0], 0.03, 1e-15);
  EXPECT_NEAR(adjusted[2], 0.06, 1e-15);
  EXPECT_NEAR(adjusted[1], 0.06, 1e-15); // never below the adjusted value of a smaller p
  EXPECT_TRUE(mc::holm({}).empty());
}

} // namespace
