#include <render/light/light.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

static_assert(LightLike<Light> && LightLike<AreaLight> && LightLike<ConstantBackground> &&
              LightLike<GradientBackground> && LightLike<Environment> && LightLike<PointLight> &&
              LightLike<DirectionalLight>);

TEST(Light, AnswersAsItsMember) {
  const GradientBackground sky;
  const Light light = sky;
  const Vec3 ref = Vec3::Zero(), wi = Vec3(1, 2, 3).normalized();
  EXPECT_TRUE((light.Le(wi, nullptr) == sky.Le(wi, nullptr)).all());
  EXPECT_EQ(light.pdf(ref, wi, nullptr), sky.pdf(ref, wi, nullptr));
  EXPECT_EQ(light.sample(ref, Vec2(Float(0.3), Float(0.7)))->wi, sky.sample(ref, Vec2(Float(0.3), Float(0.7)))->wi);
  EXPECT_EQ(light.power(2), sky.power(2));
  EXPECT_TRUE(light.is_infinite() && !light.is_delta() && !light.is_sampled());
}

} // namespace
