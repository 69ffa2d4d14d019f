#include <mc/stats/scale.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

TEST(Scale, LargestSizeCountsBothSigns) {
  EXPECT_EQ(mc::largest_size({}), 0);
  EXPECT_EQ(mc::largest_size(std::vector<double>{0, -3, 2}), 3);
  for (std::size_t at = 0; at < 20; ++at) {
    std::vector<double> x(20, 1);
    x[at] = -5;
    EXPECT_EQ(mc::largest_size(x), 5) << at;
  }
}

TEST(Scale, SquaresInUnitsOfTheExponentNeitherOverflowNorUnderflow) {
  EXPECT_EQ(mc::largest_exponent({}), 0);
  EXPECT_EQ(mc::largest_exponent(std::vector<double>{0, -0.0}), 0);
  for (const double x : {5e-324, 3e-200, 1.0, -7e200, std::numeric_limits<double>::max()}) {
    const double scaled = std::ldexp(x, -mc::largest_exponent(std::vector<double>{x / 2, x}));
    EXPECT_GE(scaled * scaled, 1) << x;
    EXPECT_LT(scaled * scaled, 4) << x;
  }
}

} // namespace
