#include <render/integrator/missing_light.h>

#include <render/render.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// A plate under a slab of glass, lit by a sun or a lamp.
Scene scene_with(bool has_sun, bool has_glass, bool has_plate) {
  SceneBuilder builder;
  const BsdfId white = builder.add(Lambert(Spectrum::Constant(Float(0.8)))), glass = builder.add(Dielectric(1.5));
  if (has_sun) builder.add(Light(PointLight(Vec3d(0, 5, 0), Spectrum::Ones())));
  builder.add(Sphere(Vec3d(9, 9, 9), 1), {white, Emission{Spectrum::Ones()}});
  if (has_plate) builder.add(Sphere(Vec3d(0, -10, 0), 9), {white});
  if (has_glass) builder.add(Sphere(Vec3d(0, 1, 0), 1), {glass});
  return builder.build();
}

TEST(MissingLight, NeedsDeltaLight_GlassAndDepth) {
  for (const char* name : {"nee", "mis", "mis+lt"}) {
    const Strategy& strategy = strategy_from(name);
    const std::optional<MissingLight> found = missing_light(scene_with(true, true, true), strategy, -1);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->light, 0u);
    EXPECT_EQ(found->surface, 2u);
    EXPECT_EQ(found->is_partial, strategy.light_path_rate > 0);
    EXPECT_FALSE(missing_light(scene_with(false, true, true), strategy, -1)) << name;
    EXPECT_FALSE(missing_light(scene_with(true, false, true), strategy, -1)) << name;
    EXPECT_FALSE(missing_light(scene_with(true, true, true), strategy, 2)) << name;
    EXPECT_TRUE(missing_light(scene_with(true, true, true), strategy, 3)) << name;
  }
}

} // namespace
