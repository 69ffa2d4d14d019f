#include <mc/warp/disk.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

// Deterministic laws here, at the bounds of the contract; the counts are taken over the whole catalogue.
TEST(UniformDisk, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformDisk<float>{}, {.samples = 50'000, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
  EXPECT_WARP_LAWS(UniformDisk<double>{}, {.samples = 50'000, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
}

TEST(UniformDisk, CentreAndCorners) {
  const UniformDisk<float> disk;
  EXPECT_EQ(disk.sample({0.5f, 0.5f}), Vec2<float>(0, 0));
  EXPECT_EQ(disk.invert({0, 0}), Vec2<float>(0.5f, 0.5f));
  const float last = one_minus_epsilon<float>;
  for (const Vec2<float>& u : {Vec2<float>(0, 0), Vec2<float>(0, last), Vec2<float>(last, 0), Vec2<float>(last, last)})
    EXPECT_GT(disk.pdf(disk.sample(u)), 0) << u.transpose();
  EXPECT_EQ(disk.pdf({1, 0.01f}), 0);
}

} // namespace
} // namespace mc
