#include <render/integrator/ray_cone.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// A quarter of a pixel: at distance d the image is 2 d tan(fov / 2) high.
TEST(RayCone, OfAPixelGrowsWithDistance) {
  const ThinLens lens({}, {.fov_axis = FovAxis::y, .fov = 90});
  RayCone cone = RayCone::of_pixel(lens, 300, 100);
  EXPECT_EQ(cone.width, 0);
  cone.advance(10);
  EXPECT_NEAR(cone.width, 0.25 * 20 / 100, 1e-6);
  cone.advance(10);
  EXPECT_NEAR(cone.width, 0.25 * 40 / 100, 1e-6);
  EXPECT_NEAR(cone.footprint(Float(-0.25)), 2 * cone.width, 1e-6);
  EXPECT_LT(cone.footprint(0), mc::infinity<Float>);
}

TEST(RayCone, OfParallelRaysKeepsItsWidth) {
  const ThinLens parallel({}, {.half_width = 3});
  RayCone cone = RayCone::of_pixel(parallel, 100, 50);
  cone.advance(1000);
  EXPECT_NEAR(cone.width, 0.25 * 6 / 100, 1e-6);
}

// Smooth reflection keeps the spread; a diffuse one widens it more than a narrow lobe.
TEST(RayCone, WidensByTheDensityOfDirections) {
  RayCone mirror{1, Float(0.01)}, narrow = mirror, diffuse = mirror;
  mirror.scatter(0);
  narrow.scatter(1000);
  diffuse.scatter(1 / mc::pi<Float>);
  EXPECT_EQ(mirror.spread, Float(0.01));
  EXPECT_GT(narrow.spread, mirror.spread);
  EXPECT_NEAR(diffuse.spread, 0.01 + 0.1, 1e-6);
}

} // namespace
