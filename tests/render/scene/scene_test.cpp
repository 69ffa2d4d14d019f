#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Emission shining(Float radiance, bool two_sided = false) { return {Spectrum::Constant(radiance), two_sided}; }

// Power 1 : 0 : 3 : 4 (two-sided counts twice); exact at the joints and the ends of the unit interval.
TEST(Scene, LightsAreChosenByPower) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  for (const Emission& e : {shining(1), shining(0), shining(3), shining(2, true), shining(0)})
    builder.add(Sphere(Vec3d::Zero(), 1), {gray, e});
  const Scene scene = builder.build();
  ASSERT_TRUE(scene.light_choice());
  const auto& choice = *scene.light_choice();
  const Float expected[] = {Float(0.125), 0, Float(0.375), Float(0.5), 0};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(choice.pmf(i), expected[i], 1e-6);
  int counts[5] = {};
  for (int i = 0; i < 8000; ++i) {
    const auto one = choice.sample_index((Float(i) + Float(0.5)) / 8000);
    ++counts[one.index];
    EXPECT_EQ(one.pmf, choice.pmf(one.index));
  }
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(counts[i], 8000 * double(expected[i]), 1) << i;
  EXPECT_EQ(choice.sample_index(0).index, 0u);
  EXPECT_EQ(choice.sample_index(mc::one_minus_epsilon<Float>).index, 3u);
}

TEST(Scene, NobodyConnectsToABackgroundOrToDarkLights) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(Sphere(Vec3d::Zero(), 1), {gray, shining(0)});
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  const Scene dark = builder.build();
  EXPECT_FALSE(dark.light_choice());
  ASSERT_EQ(dark.infinite_lights().size(), 1u);
  EXPECT_EQ(dark.infinite_lights()[0], 1u);
}

TEST(Scene, TellsWhatCoversAHit) {
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
  EXPECT_FALSE(scene.bsdf(scene.surface(*lamp)).is_delta());
  EXPECT_TRUE(scene.bsdf(scene.surface(*ball)).is_delta());
  const SurfacePoint p = scene.surface_point(ahead, *lamp);
  EXPECT_TRUE((scene.lights()[0].emitted(ahead.d, &p) == 2).all());
  EXPECT_TRUE(scene.occluded(ahead));
  EXPECT_FALSE(scene.occluded({Vec3::Zero(), Vec3::UnitX()}));
}

} // namespace
