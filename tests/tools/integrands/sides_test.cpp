#include <integrands/sides.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

// dx/du is the derivative, x rises from lo to hi.
TEST(Sides, AreWalkedFromEndToEnd) {
  for (const char* box : {"x=-2:3", "x=1:inf", "x=-inf:-1", "x=-inf:inf"}) {
    const carlo::Side side = carlo::parse_sides(box)[0];
    EXPECT_EQ(carlo::place_on(side, 0).x, side.lo) << box;
    for (double u = 0.01; u < 0.995; u += 0.01) {
      const double h = 1e-6, rise = carlo::place_on(side, u + h).x - carlo::place_on(side, u - h).x;
      EXPECT_NEAR(carlo::place_on(side, u).slope / (rise / (2 * h)), 1, 1e-6) << box << " at " << u;
    }
    const double last = carlo::place_on(side, 1 - 0x1p-53).x;
    EXPECT_TRUE(std::isfinite(last)) << box;
    EXPECT_TRUE(std::isfinite(side.hi) ? std::abs(last - side.hi) < 1e-14 : last > 1e14) << box;
  }
}

TEST(Sides, AreReadWithBlanks) {
  const std::vector<carlo::Side> sides = carlo::parse_sides(" x = 0 : 1, y= -inf :2 ");
  ASSERT_EQ(sides.size(), 2u);
  EXPECT_EQ(sides[0].name, "x");
  EXPECT_EQ(sides[0].hi, 1);
  EXPECT_EQ(sides[1].name, "y");
  EXPECT_EQ(sides[1].lo, -HUGE_VAL);
}

} // namespace
