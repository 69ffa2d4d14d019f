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

} // namespace
