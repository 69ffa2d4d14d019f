#include <render/light/light.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

static_assert(LightLike<Light> && LightLike<AreaLight> && LightLike<ConstantBackground> &&
              LightLike<GradientBackground> && LightLike<Environment> && LightLike<PointLight> &&
              LightLike<DirectionalLight> && LightLike<SpotLight>);

TEST(Light, AnswersAsItsMember) {
  const GradientBackground sky;
  const Light light = sky;
  const Vec3 ref = Vec3::Zero(), wi = Vec3(1, 2, 3).normalized();
  EXPECT_TRUE((light.Le(wi, nullptr) == sky.Le(wi, nullptr)).all());
  EXPECT_EQ(light.pdf(ref, wi, nullptr), sky.pdf(ref, wi, nullptr));
  EXPECT_EQ(light.sample(ref, Vec2(Float(0.3), Float(0.7)))->wi, sky.sample(ref, Vec2(Float(0.3), Float(0.7)))->wi);
  EXPECT_EQ(light.power(2), sky.power(2));
  const Sphere ball(Vec3d(1, 2, 3), 2);
  const EmissionTargets targets({ball}, {}, Bounds::around(ball.box()));
  const Vec2 u(Float(0.3), Float(0.7)), v(Float(0.2), Float(0.4));
  const auto first = light.sample_emission(targets, u, v), expected = sky.sample_emission(targets, u, v);
  ASSERT_TRUE(first && expected);
  EXPECT_EQ(first->ray.o, expected->ray.o);
  EXPECT_EQ(light.emission_pdf(targets, ref, wi, nullptr), sky.emission_pdf(targets, ref, wi, nullptr));
  EXPECT_TRUE(light.is_infinite() && !light.is_delta() && !light.is_sampled());
}

} // namespace
