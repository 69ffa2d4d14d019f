#include <render/core/box.h>

#include <gtest/gtest.h>

namespace {

TEST(Box, HoldsWhatWasAdded) {
  render::Box box, other;
  EXPECT_EQ(box.half_area(), 0);
  box.add(render::Vec3(1, 2, 3));
  EXPECT_EQ(box.half_area(), 0);
  other.add(render::Vec3(0, 0, 0));
  box.add(other);
  EXPECT_EQ(box.lo, render::Vec3(0, 0, 0));
  EXPECT_EQ(box.hi, render::Vec3(1, 2, 3));
  EXPECT_EQ(box.half_area(), 2 + 6 + 3);
  box.add(render::Box{});
  EXPECT_EQ(box.half_area(), 11);
}

} // namespace
