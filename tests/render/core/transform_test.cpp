#include <render/core/transform.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Transform, AppliesTheFirstFirst) {
  const Transform t = Transform::translate({1, 2, 3}) * Transform::scale({2, 3, 4});
  EXPECT_EQ(t.point({1, 1, 1}), Vec3d(3, 5, 7));
  EXPECT_EQ(t.vector({1, 1, 1}), Vec3d(2, 3, 4));
  const Transform back = Transform::scale({2, 3, 4}) * Transform::translate({1, 2, 3});
  EXPECT_EQ(back.point({1, 1, 1}), Vec3d(4, 9, 16));
  EXPECT_EQ(Transform{}.point({1, 2, 3}), Vec3d(1, 2, 3));
}

TEST(Transform, RotatesByTheRightHand) {
  EXPECT_LE((Transform::rotate({0, 0, 2}, 90).point({1, 0, 0}) - Vec3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_LE((Transform::rotate({1, 1, 1}, 120).point({1, 0, 0}) - Vec3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_THROW(Transform::rotate({0, 0, 0}, 90), mc::Error);
}

TEST(Transform, LooksAtItsTarget) {
  const Transform t = Transform::look_at({1, 2, 3}, {1, 2, 7}, {0, 5, 0});
  EXPECT_EQ(t.point({0, 0, 1}), Vec3d(1, 2, 4));
  EXPECT_EQ(t.vector({0, 1, 0}), Vec3d(0, 1, 0));
  EXPECT_EQ(t.vector({1, 0, 0}), Vec3d(1, 0, 0)); // +x is to the left when looking along +z with y up
  EXPECT_FALSE(t.mirrors());
  for (const double far : {1e-200, 1e200}) // the square underflows or overflows
    EXPECT_TRUE(Transform::look_at({0, 0, far}, {0, 0, 0}, {0, far, 0})
                    .linear.isApprox(Transform::look_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0}).linear));
  EXPECT_THROW(Transform::look_at({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), mc::Error);
  EXPECT_THROW(Transform::look_at({1, 2, 3}, {1, 4, 3}, {0, 1, 0}), mc::Error);
}

// A normal stays perpendicular to tangents, and outward under mirroring.
TEST(Transform, NormalsStayOutward) {
  const Transform t = Transform::columns({2, 0, 1}, {0.5, -3, 0}, {0, 1, 1.5}, {7, 8, 9});
  EXPECT_TRUE(t.mirrors());
  const Vec3d n(0.3, -0.2, 0.9), along = mc::cross<double>(n, Vec3d(1, 2, 3));
  EXPECT_NEAR(t.normal(n).dot(t.vector(along)), 0, 1e-12);
  EXPECT_GE(t.normal(n).dot(t.vector(n)), 0);
}

} // namespace
