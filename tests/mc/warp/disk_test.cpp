#include <mc/warp/disk.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

// Deterministic laws with the bounds of the contract. The statistical tests run over the whole catalogue.
TEST(UniformDisk, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformDisk<float>{},
                   {.statistics = {.samples = 50'000}, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
  EXPECT_WARP_LAWS(UniformDisk<double>{},
                   {.statistics = {.samples = 50'000}, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
}

TEST(UniformDiskPolar, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformDiskPolar<float>{},
                   {.statistics = {.samples = 50'000}, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
  EXPECT_WARP_LAWS(UniformDiskPolar<double>{},
                   {.statistics = {.samples = 50'000}, .invert_eps = 8, .sample_eps = 4, .pdf_eps = 2});
}

// At the rim the polar map stretches a side of one of 16 x 16 cells to 2 pi / 16, the concentric map to at most 0.16.
TEST(UniformDiskPolar, StretchesStrataMoreThanTheConcentricMap) {
  const auto stretch = [](const auto& disk) {
    double longest = 0;
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 16; ++j)
        longest = std::max(
            longest,
            (disk.sample({(i + 0.999) / 16, (j + 0.999) / 16}) - disk.sample({(i + 0.999) / 16, j / 16.0})).norm());
    return longest;
  };
  EXPECT_GT(stretch(UniformDiskPolar<double>{}), 2 * stretch(UniformDisk<double>{}));
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
