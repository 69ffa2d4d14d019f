#include <render/accel/cylinder_block.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace render;

// A block of cylinders, one per lane, returns the nearest of the hits of the single shapes.
TEST(CylinderBlock, FindsWhatTheCylindersFind) {
  mc::Pcg random(4);
  std::vector<Cylinder> cylinders;
  for (int i = 0; i < 8; ++i)
    cylinders.emplace_back(4 * random.point<double, 3>(), 4 * random.point<double, 3>(),
                           0.1 + 0.5 * random.uniform<double>());
  CylinderBlock block;
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    CylinderBlock::Primitive found[1];
    ASSERT_EQ(CylinderBlock::collect(cylinders[lane], int(lane), 0, 1, found), found + 1);
    block.set(lane, found[0]);
  }
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 o = 6 * random.point<Float, 3>() - Vec3::Ones(), to = 4 * random.point<Float, 3>();
    const Ray ray{o, (to - o).normalized()};
    double nearest = mc::infinity<double>;
    for (const Cylinder& c : cylinders) nearest = std::min(nearest, c.intersect(ray).value_or(nearest));
    Float t_max = ray.t_max;
    Hit hit;
    const CylinderBlock::RaySetup prepared(ray);
    ASSERT_EQ(block.intersect<true>(ray, prepared, t_max, hit), nearest < mc::infinity<double>);
    if (!block.intersect<false>(ray, prepared, t_max, hit)) continue;
    ++hits;
    EXPECT_NEAR(hit.t, nearest, 1e-13 * (1 + nearest));
    EXPECT_EQ(t_max, Float(hit.t));
  }
  EXPECT_GE(hits, 300);
}

} // namespace
