#include <mc/warp/triangle.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

TEST(UniformTriangle, ObeysTheLaws) {
  EXPECT_WARP_LAWS(UniformTriangle<float>{}, {.statistics = {.samples = 50'000}, .invert_eps = 4, .pdf_eps = 1});
  EXPECT_WARP_LAWS(UniformTriangle<double>{}, {.statistics = {.samples = 50'000}, .invert_eps = 4, .pdf_eps = 1});
}

TEST(UniformTriangle, NeighboursStayNeighbours) {
  const UniformTriangle<double> warp;
  Pcg random(7);
  for (int i = 0; i < 10'000; ++i) {
    const auto u = random.point<double, 2>();
    const Vec2<double> v = u + 1e-6 * random.point<double, 2>();
    EXPECT_LE((warp.sample(u) - warp.sample(v)).norm(), 2 * (u - v).norm());
  }
}

} // namespace
} // namespace mc
