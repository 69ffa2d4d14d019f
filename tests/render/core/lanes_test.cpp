#include <render/core/lanes.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

const Float nan = std::numeric_limits<Float>::quiet_NaN();

TEST(Lanes, ComparisonsByLane) {
  const Lanes a = {1, 2, 3, 4, nan, 6, -7, 0}, b = {2, 2, 2, 5, 1, nan, -8, 0};
  EXPECT_EQ(detail::less_equal(a, b), 0b10001011u);
  const Lanes high = detail::larger(a, b), low = detail::smaller(a, b);
  const Float highest[] = {2, 2, 3, 5, 1}, lowest[] = {1, 2, 2, 4, 1};
  for (int i = 0; i < 5; ++i) { // a NaN on the left keeps the old value
    EXPECT_EQ(high[i], highest[i]) << i;
    EXPECT_EQ(low[i], lowest[i]) << i;
  }
}

TEST(Lanes, RootsAndChoices) {
  const EightDoubles x = {0, 1, 2, 3, 1e-300, 1e300, 0.25, 7};
  const EightDoubles root = detail::square_root(x);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(root[i], std::sqrt(x[i]));
  EXPECT_EQ(detail::lane_bits(x > 2.5), 0b10101000u);
  EXPECT_EQ(detail::lane_bits(x < 0.0), 0u);
  EXPECT_EQ(detail::lane_bits(x >= 0.0), 0xffu);
}

} // namespace
