#include <mc/estimate/integrate/corrections/skewness.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using mc::detail::skew_of_mean;
using mc::detail::skewness_shift;

TEST(Skewness, SkewOfTheMean) {
  EXPECT_EQ(skew_of_mean(std::vector<double>{}), 0);
  EXPECT_EQ(skew_of_mean(std::vector<double>{3, 3, 3}), 0);
  EXPECT_NEAR(skew_of_mean(std::vector<double>{1, 2, 3, 4}), 0, 1e-12);
  for (const double scale : {-1e-200, 1.0, 1e200}) {
    // 0 0 0 4: mean 1, variance 4, third central moment 6, unbiased factor 16 / 6; over 8 and 6 sqrt(4).
    const double skew = skew_of_mean(std::vector<double>{0, 0, 0, 4 * scale});
    EXPECT_NEAR(skew, std::copysign(6.0 * 16 / 6 / 8 / 12, scale), 1e-12);
  }
}

TEST(Skewness, ShiftPointsToTheSkewedSide) {
  EXPECT_DOUBLE_EQ(skewness_shift(0.1, 2, 2), 0.1 * 2 * 9);
  EXPECT_LT(skewness_shift(-0.1, 2, 2), 0);
  mc::detail::Tuning none;
  none.skewness = 0;
  EXPECT_EQ(skew_of_mean(std::vector<double>{0, 0, 0, 4}, none), 0);
}

} // namespace
