#include <mc/domain/sphere.h>

#include "support/chart.h"

namespace {

TEST(Sphere, Chart) {
  support::expect_chart(mc::Sphere<float>(), 8);
  support::expect_chart(mc::Sphere<double>(), 8);
}

TEST(Sphere, TheNorthPoleKeepsItsPrecision) {
  for (const double v : {1e-30, 1e-20, 1e-10}) {
    const mc::Sphere<double> sphere;
    EXPECT_NEAR(sphere.to_unit(sphere.from_unit({v, 0.3}))[0] / v, 1, 1e-14);
  }
}

TEST(Sphere, ContainsUnitVectorsOnly) {
  const mc::Sphere<float> sphere;
  EXPECT_TRUE(sphere.contains({0, 0, -1}));
  EXPECT_FALSE(sphere.contains({0, 0, 1.00001f}));
  EXPECT_FALSE(sphere.contains({0, NAN, 1}));
}

} // namespace
