#include <render/core/ray.h>

#include <gtest/gtest.h>

namespace {

TEST(Ray, PointsLieAlongTheDirection) {
  const render::Ray ray{{1, 2, 3}, {0, 0, -1}};
  EXPECT_EQ(ray.at(2), render::Vec3(1, 2, 1));
  EXPECT_EQ(ray.t_max, mc::infinity<render::Float>);
}

} // namespace
