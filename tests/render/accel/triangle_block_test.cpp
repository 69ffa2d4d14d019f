#include <render/accel/triangle_block.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(TriangleBlock, CollectsWhatCanBeHit) {
  TriangleBlock::Primitive found[3];
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 3, 2}, {1, 2, 3}});
  EXPECT_EQ(TriangleBlock::size(mesh), 4u);
  ASSERT_EQ(TriangleBlock::collect(mesh, 7, 0, 3, found), found + 2) << "the degenerate one is left out";
  EXPECT_EQ(found[1].shape, 7);
  EXPECT_EQ(found[1].prim, 2);
  EXPECT_EQ(found[0].bounds().hi, Vec3(1, 1, 0));
}

TEST(TriangleBlock, ReturnsNearestLane) {
  TriangleBlock block;
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    const Float z = Float((lane * 5) % 8) + 1;
    const TriangleMesh mesh({{0, 0, z}, {1, 0, z}, {0, 1, z}}, std::vector<std::array<std::uint32_t, 3>>(4, {0, 1, 2}));
    block.set(lane, {&mesh, int(lane), 3});
  }
  const Ray ray{Vec3(Float(0.25), Float(0.5), 0), Vec3::UnitZ()};
  const TriangleBlock::RaySetup prepared(ray);
  Float t_max = ray.t_max;
  Hit hit;
  ASSERT_TRUE(block.intersect<false>(ray, prepared, t_max, hit));
  EXPECT_EQ(hit.shape, 0);
  EXPECT_EQ(hit.prim, 3);
  EXPECT_EQ(hit.t, 1);
  EXPECT_EQ(t_max, 1);
  EXPECT_NEAR(hit.b1, 0.25, 1e-6);
  EXPECT_NEAR(hit.b2, 0.5, 1e-6);
  EXPECT_FALSE(block.intersect<false>(ray, prepared, t_max, hit)) << "nothing is nearer than the nearest";
  EXPECT_FALSE(block.intersect<true>({Vec3(2, 2, 0), Vec3::UnitZ()}, prepared, t_max, hit));
}

} // namespace
