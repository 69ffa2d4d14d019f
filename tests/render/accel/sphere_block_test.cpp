#include <render/accel/sphere_block.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(SphereBlock, CollectsSpheresInBoxesThatHoldThem) {
  SphereBlock::Primitive found[2];
  const Sphere ball(Vec3d(0.1, 0.2, 0.3), 0.7);
  EXPECT_EQ(SphereBlock::size(ball), 1u);
  ASSERT_EQ(SphereBlock::collect(ball, 1, 0, 1, found), found + 1);
  EXPECT_EQ(found[0].shape, 1);
  for (int a = 0; a < 3; ++a) {
    EXPECT_LE(double(found[0].bounds().lo[a]), 0.1 * (a + 1) - 0.7);
    EXPECT_GE(double(found[0].bounds().hi[a]), 0.1 * (a + 1) + 0.7);
  }
}

// A block of spheres and caps, one per lane, returns the nearest of the hits of the single shapes.
TEST(SphereBlock, FindsWhatTheSpheresFind) {
  mc::Pcg random(4);
  std::vector<Sphere> spheres;
  SphereBlock block;
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    const Vec3d center = 4 * random.point<double, 3>();
    spheres.push_back(lane % 2 ? Sphere(center, 0.8) : Sphere::cap(center, 0.8, {1, 2, -1}, 0.5));
    block.set(lane, {&spheres.back(), int(lane)});
  }
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 o = 6 * random.point<Float, 3>() - Vec3::Ones(), to = 4 * random.point<Float, 3>();
    const Ray ray{o, (to - o).normalized()};
    double nearest = mc::infinity<double>;
    for (const Sphere& s : spheres) nearest = std::min(nearest, s.intersect(ray).value_or(nearest));
    Float t_max = ray.t_max;
    Hit hit;
    const SphereBlock::RaySetup prepared(ray);
    ASSERT_EQ(block.intersect<true>(ray, prepared, t_max, hit), nearest < mc::infinity<double>);
    if (!block.intersect<false>(ray, prepared, t_max, hit)) continue;
    ++hits;
    EXPECT_EQ(Float(hit.t), Float(nearest));
    EXPECT_EQ(t_max, Float(hit.t));
    EXPECT_EQ(Float(spheres[std::size_t(hit.shape)].intersect(ray).value()), Float(hit.t));
  }
  EXPECT_GE(hits, 300);
}

} // namespace
