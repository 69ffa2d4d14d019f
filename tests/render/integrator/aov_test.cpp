#include <render/integrator/aov.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

#include "support/traced.h"

// tests/render/ambient_occlusion_test.cpp compares ambient occlusion with closed forms.
namespace {

using namespace render;

// The shading normal as a colour instead of radiance; without a hit, the sky.
TEST(AovIntegrator, ShowsNormals) {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum::Constant(Float(0.3)))));
  builder.add(Sphere(Vec3d::Zero(), 1), {builder.add(Lambert()), Emission{}});
  const Scene scene = builder.build();
  const Vec3 n = Vec3(1, -2, 3).normalized();
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(support::aov_samples(scene, {Vec3(5 * n), Vec3(-n)}, Aov::normals, 10, channel).mean(),
                (double(n[channel]) + 1) / 2, 1e-5);
    EXPECT_NEAR(support::aov_samples(scene, {Vec3(5 * n), n}, Aov::normals, 10, channel).mean(), 0.3, 1e-6);
  }
}

} // namespace
