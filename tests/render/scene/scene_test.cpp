#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Emission shining(Float radiance, bool two_sided = false) { return {Spectrum::Constant(radiance), two_sided}; }

TEST(Scene, BackgroundsAndBlackLightsAreNotSampled) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(Sphere(Vec3d::Zero(), 1), {gray, shining(0)});
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  const Scene dark = builder.build();
  EXPECT_FALSE(dark.has_light_sampler());
  ASSERT_EQ(dark.infinite_lights().size(), 1u);
  EXPECT_EQ(dark.infinite_lights()[0], 1u);
}

TEST(Scene, ReturnsBsdfAtHit) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert()), glass = builder.add(Dielectric());
  builder.add(Sphere(Vec3d(0, 0, 5), 1), {gray, shining(2)});
  builder.add(Sphere(Vec3d(0, 0, -5), 1), {glass});
  const Scene scene = builder.build();
  const Ray ahead{Vec3::Zero(), Vec3::UnitZ()}, back{Vec3::Zero(), -Vec3::UnitZ()};
  const auto lamp = scene.intersect(ahead), ball = scene.intersect(back);
  ASSERT_TRUE(lamp && ball);
  EXPECT_EQ(scene.surface(*lamp).light, std::optional(0u));
  EXPECT_FALSE(scene.surface(*ball).light);
  EXPECT_FALSE(scene.bsdf(scene.surface(*lamp)).lobes().is_delta());
  EXPECT_TRUE(scene.bsdf(scene.surface(*ball)).lobes().is_delta());
  const SurfacePoint p = scene.surface_point(ahead, *lamp);
  EXPECT_TRUE((scene.lights()[0].Le(ahead.d, &p) == 2).all());
  EXPECT_TRUE(scene.occluded(ahead));
  EXPECT_FALSE(scene.occluded({Vec3::Zero(), Vec3::UnitX()}));
}

} // namespace
