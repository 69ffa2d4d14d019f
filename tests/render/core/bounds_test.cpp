#include <render/core/bounds.h>

#include <gtest/gtest.h>

namespace {

TEST(Bounds, HoldsWhatWasAdded) {
  render::Bounds bounds, other;
  EXPECT_EQ(bounds.half_area(), 0);
  bounds.add(render::Vec3(1, 2, 3));
  EXPECT_EQ(bounds.half_area(), 0);
  other.add(render::Vec3(0, 0, 0));
  bounds.add(other);
  EXPECT_EQ(bounds.lo, render::Vec3(0, 0, 0));
  EXPECT_EQ(bounds.hi, render::Vec3(1, 2, 3));
  EXPECT_EQ(bounds.half_area(), 2 + 6 + 3);
  bounds.add(render::Bounds{});
  EXPECT_EQ(bounds.half_area(), 11);
}

TEST(Bounds, ExitDistanceBoundsTheBox) {
  render::Bounds bounds;
  bounds.add(render::Vec3(0, 0, 0));
  bounds.add(render::Vec3(1, 2, 3));
  using render::Vec3d;
  EXPECT_EQ(bounds.exit_distance({0.5, 0.5, 0.5}, {0, 2, 0}), 0.75);
  EXPECT_EQ(bounds.exit_distance({0.5, 0.5, 0.5}, {0, -2, 0}), 0.25);
  EXPECT_EQ(bounds.exit_distance({0.5, 0.5, 0.5}, {1, 1, -1}), 0.5);
  EXPECT_EQ(bounds.exit_distance({0.5, 5, 0.5}, Vec3d::UnitY()), -3); // the box lies behind p
  EXPECT_EQ(bounds.exit_distance({0.5, -5, 0.5}, Vec3d::UnitY()), 7);
  EXPECT_EQ(bounds.exit_distance({1, 1, 1}, Vec3d::UnitX()), 0);
}

// Rounding to Float never cuts the box.
TEST(Bounds, AroundDoubles_IsRoundedOutward) {
  const Eigen::AlignedBox3d box(render::Vec3d(-0.1, 0.2, 1e10 + 0.3), render::Vec3d(0.1, 0.3, 1e10 + 0.4));
  const render::Bounds b = render::Bounds::around(box);
  for (int a = 0; a < 3; ++a) {
    EXPECT_LE(double(b.lo[a]), box.min()[a]);
    EXPECT_GE(double(b.hi[a]), box.max()[a]);
    EXPECT_NEAR(double(b.hi[a]), box.max()[a], 2e-7 * (1 + box.max()[a]));
  }
}

} // namespace
