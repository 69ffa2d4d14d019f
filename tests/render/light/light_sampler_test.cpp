#include <render/light/light_sampler.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Light ball(const Vec3d& center, double radius, double radiance) {
  return AreaLight(std::make_shared<const Shape>(Sphere(center, radius)),
                   Emission{Spectrum::Constant(Float(radiance))});
}

// Black lights and lights without sampling are never selected. The others share two thirds by irradiance, one
// uniformly.
TEST(LightSampler, ProbabilityFollowsIrradiance) {
  const std::vector<Light> lights = {ball({0, 0, 3}, 1, 1), ball({0, 0, 1}, 1, 0), ball({0, 6, 0}, 1, 2),
                                     Light(ConstantBackground(Spectrum::Ones()))};
  const auto choice = LightSampler::create(lights, 10);
  ASSERT_TRUE(choice);
  // The irradiances are pi / 9 and 2 pi / 36.
  const double first = 2.0 / 3 * 2 / 3 + 1.0 / 6;
  EXPECT_NEAR(choice->pmf(lights, Vec3::Zero(), 0), first, 1e-6);
  EXPECT_NEAR(choice->pmf(lights, Vec3::Zero(), 2), 1 - first, 1e-6);
  EXPECT_EQ(choice->pmf(lights, Vec3::Zero(), 1), 0);
  EXPECT_EQ(choice->pmf(lights, Vec3::Zero(), 3), 0);
  EXPECT_EQ(choice->sample_index(lights, Vec3::Zero(), 0).index, 0u);
  EXPECT_EQ(choice->sample_index(lights, Vec3::Zero(), mc::one_minus_epsilon<Float>).index, 2u);
  EXPECT_GT(choice->pmf(lights, Vec3(0, 5, 0), 2), Float(0.8)) << "near the other one";
}

TEST(LightSampler, NoLights_CreatesNone) {
  EXPECT_FALSE(LightSampler::create({}, 1));
  const std::vector<Light> dark = {ball({0, 0, 3}, 1, 0), Light(ConstantBackground(Spectrum::Ones()))};
  EXPECT_FALSE(LightSampler::create(dark, 1));
}

// Random lights of any size, position and strength: one up to twice the largest number that is weighted by irradiance.
// Reference points may lie inside lights. Probabilities add up to 1, samples match pmf(), and every light is selected.
TEST(LightSampler, EveryLightHasMinimumProbability) {
  mc::Pcg random(8);
  const auto number = [&](double decades) { return std::pow(10, decades * (2 * random.uniform<double>() - 1)); };
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t n = 1 + static_cast<std::size_t>(trial) % (2 * LightSampler::max_weighted_lights);
    std::vector<Light> lights;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3d at(number(6), number(6), -number(6));
      lights.push_back(i % 2 == 0 ? ball(at, number(6), number(15))
                                  : Light(AreaLight(std::make_shared<const Shape>(TriangleMesh::rectangle(
                                                        Transform::translate(at) * Transform::scale({2, 3, 1}))),
                                                    Emission{Spectrum::Constant(Float(number(15)))})));
    }
    const auto choice = LightSampler::create(lights, 1e6);
    ASSERT_TRUE(choice);
    const Vec3 ref(Float(number(6)), Float(number(6)), Float(-number(6)));
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double pmf = double(choice->pmf(lights, ref, i));
      EXPECT_GE(pmf, 0.3333 / double(n));
      sum += pmf;
    }
    EXPECT_NEAR(sum, 1, 1e-6 * double(n));
    for (const Float u : {Float(0), random.uniform<Float>(), mc::one_minus_epsilon<Float>}) {
      const auto s = choice->sample_index(lights, ref, u);
      ASSERT_LT(s.index, n);
      EXPECT_EQ(s.pmf, choice->pmf(lights, ref, s.index));
    }
  }
}

} // namespace
