#include <mc/warp/sphere.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

TEST(UniformSphere, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformSphere<float>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 2});
  EXPECT_WARP_LAWS(UniformSphere<double>{}, {.statistics = {.samples = 50'000}, .invert_eps = 8, .pdf_eps = 2});
}

// The integral of cos^2 over the sphere is 4 pi / 3. Alpha 1e-3, fixed seed.
TEST(UniformSphere, CosineSquared) {
  Pcg random(6);
  const UniformSphere<double> warp;
  std::vector<double> values;
  for (int i = 0; i < 100'000; ++i) {
    const auto w = warp.sample(random.point<double, 2>());
    values.push_back(sqr(w.z()) / warp.pdf(w));
  }
  EXPECT_MEAN(values, 4.188790204786391);
}

} // namespace
} // namespace mc
