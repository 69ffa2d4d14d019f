#include <render/accel/disk_block.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace render;

// A block of disks, one per lane, returns the nearest of the hits of the single shapes.
TEST(DiskBlock, FindsWhatTheDisksFind) {
  mc::Pcg random(4);
  std::vector<Disk> disks;
  for (int i = 0; i < 8; ++i)
    disks.emplace_back(Transform::translate(4 * random.point<double, 3>()) *
                       Transform::rotate(random.point<double, 3>(), 360 * random.uniform<double>()) *
                       Transform::scale({1.5, 0.5, 1}));
  DiskBlock block;
  for (std::uint32_t lane = 0; lane < 8; ++lane) {
    DiskBlock::Primitive found[1];
    ASSERT_EQ(DiskBlock::size(disks[lane]), 1u);
    ASSERT_EQ(DiskBlock::collect(disks[lane], int(lane), 0, 1, found), found + 1);
    block.set(lane, found[0]);
    for (int a = 0; a < 3; ++a) {
      EXPECT_LE(double(found[0].bounds().lo[a]), disks[lane].box().min()[a]);
      EXPECT_GE(double(found[0].bounds().hi[a]), disks[lane].box().max()[a]);
    }
  }
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 o = 6 * random.point<Float, 3>() - Vec3::Ones(), to = 4 * random.point<Float, 3>();
    const Ray ray{o, (to - o).normalized()};
    double nearest = mc::infinity<double>;
    for (const Disk& d : disks) nearest = std::min(nearest, d.intersect(ray).value_or(nearest));
    Float t_max = ray.t_max;
    Hit hit;
    const DiskBlock::RaySetup prepared(ray);
    ASSERT_EQ(block.intersect<true>(ray, prepared, t_max, hit), nearest < mc::infinity<double>);
    if (!block.intersect<false>(ray, prepared, t_max, hit)) continue;
    ++hits;
    EXPECT_EQ(hit.t, nearest);
    EXPECT_EQ(t_max, Float(hit.t));
    EXPECT_EQ(disks[std::size_t(hit.shape)].intersect(ray), hit.t);
  }
  EXPECT_GE(hits, 300);
}

} // namespace
