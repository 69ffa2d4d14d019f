#include <mc/estimate/integrate/mean.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::detail::Mean;

TEST(Mean, WelchLiesBetweenTheSmallerAndTheSum) {
  EXPECT_DOUBLE_EQ(mc::detail::welch({0, 1, 10}, {0, 1, 10}), 20);
  EXPECT_DOUBLE_EQ(mc::detail::welch({0, 1, 10}, {0, 0, 3}), 10);
  EXPECT_DOUBLE_EQ(mc::detail::welch({0, 0, 10}, {0, 0, 3}), 13);
  EXPECT_NEAR(mc::detail::welch({0, 1e-300, 10}, {0, 1e-300, 10}), 20, 1e-9); // the squares would underflow
}

TEST(Mean, DeviateIsThatOfANormal) {
  // Student's t of many degrees of freedom is the normal.
  EXPECT_NEAR(mc::detail::deviate({0, 0.5, 1e9}, {2, 0.5, 1e9}).value(), 2, 1e-6);
  // 2.069 is the 97.5 % quantile of 23 degrees of freedom, 1.960 that of the normal.
  EXPECT_NEAR(mc::detail::deviate({0, 1, 23}, {2.0687, 0, 23}).value(), 1.95996, 1e-4);
  EXPECT_FALSE(mc::detail::deviate({1, 0, 23}, {2, 0, 23}).has_value());
  EXPECT_LE(mc::detail::deviate({1, 1e-40, 23}, {1 + 1e-15, 0, 23}).value(), 1); // rounding is no disagreement
}

} // namespace
