#include <mc/domain/sphere.h>

#include <mc/random/pcg.h>

#include "support/domain_laws.h"

namespace {

TEST(Sphere, Chart) {
  support::expect_domain_laws(mc::Sphere<float>(), 8);
  support::expect_domain_laws(mc::Sphere<double>(), 8);
}

TEST(Sphere, TheNorthPoleKeepsItsPrecision) {
  for (const double v : {1e-30, 1e-20, 1e-10}) {
    const mc::Sphere<double> sphere;
    EXPECT_NEAR(sphere.to_unit(sphere.from_unit({v, 0.3}))[0] / v, 1, 1e-14);
  }
}

// For directions rounded to float near a pole, z is exactly 1 or -1. The chart must still distinguish them.
TEST(Sphere, RoundedDirectionsKeepTheirPlaceAtThePoles) {
  for (const float r : {1e-4f, 1e-6f})
    for (const float z : {1.0f, -1.0f}) {
      const double v = mc::Sphere<double>().to_unit(mc::Vec3<float>(0.6f * r, 0.8f * r, z).cast<double>())[0];
      EXPECT_NEAR((z > 0 ? v : 1 - v) / (0.25 * mc::sqr(double(r))), 1, 1e-2) << r << " " << z;
    }
}

// Reflections about a normalised vector are not normalised again by renderers, and must count as unit.
TEST(Sphere, ContainsReflectionsInNormalisedVectors) {
  mc::Pcg random(1);
  const auto unit = [&] {
    const mc::Vec3<float> v(random.uniform<float>() - 0.5f, random.uniform<float>() - 0.5f, random.uniform<float>());
    return mc::Vec3<float>(v / std::sqrt(v.dot(v)));
  };
  for (int i = 0; i < 1'000'000; ++i) {
    const mc::Vec3<float> w = unit(), h = unit();
    ASSERT_TRUE(mc::Sphere<float>().contains(-w + 2 * w.dot(h) * h)) << w.transpose() << " in " << h.transpose();
  }
}

TEST(Sphere, ContainsUnitVectorsOnly) {
  const mc::Sphere<float> sphere;
  EXPECT_TRUE(sphere.contains({0, 0, -1}));
  EXPECT_FALSE(sphere.contains({0, 0, 1.00001f}));
  EXPECT_FALSE(sphere.contains({0, NAN, 1}));
}

} // namespace
