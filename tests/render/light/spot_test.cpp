#include <render/light/spot.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;

// The intensity is 1 up to the beam angle and falls linearly to 0 at the cutoff angle.
TEST(SpotLight, FallsLinearlyFromBeamToCutoff) {
  for (const SpotLight::Cone& cone : {SpotLight::Cone{20, 15}, {0.02, 0.01}, {170, 10}, {90, 0}, {30, 30}}) {
    const SpotLight light(Vec3d(1, 2, 3), Vec3d(0, 0, -4), Spectrum::Ones(), cone);
    for (const double degrees : {0.0, 0.005, 0.0125, 0.0175, 0.021, 5.0, 14.9, 17.5, 20.1, 29.9, 30.1, 60.0, 150.0}) {
      const double angle = degrees * mc::pi<double> / 180;
      const Vec3d d(std::sin(angle), 0, -std::cos(angle));
      const double expected =
          degrees <= cone.beam ? 1 : std::max(0.0, (cone.cutoff - degrees) / (cone.cutoff - cone.beam));
      EXPECT_NEAR(light.falloff(1e-9 * d), expected, 1e-6) << cone.cutoff << " " << degrees;
      const Vec3 ref = (Vec3d(1, 2, 3) + 2 * d).cast<Float>();
      const auto s = light.sample(ref, {});
      ASSERT_EQ(s.has_value(), expected > 0) << cone.cutoff << " " << degrees;
      EXPECT_GT(light.irradiance(ref), 0);
      if (!s || cone.cutoff < 1) continue; // rounding of ref matters in the narrow cone
      EXPECT_EQ(s->pdf, 1);
      EXPECT_NEAR(double(s->radiance[1]), expected / 4, 1e-5);
      EXPECT_LE((s->wi + d.cast<Float>()).norm(), 1e-6);
      EXPECT_NEAR(light.irradiance(ref), std::max(expected, 1e-3) / 4, 1e-5);
    }
  }
}

// The power is the integral of the intensity, by the midpoint rule with 100,000 steps in the angle.
TEST(SpotLight, PowerIsIntegralOfIntensity) {
  for (const SpotLight::Cone& cone :
       {SpotLight::Cone{20, 15}, {1, 0.5}, {180, 0}, {180, 180}, {90, 30}, {45, 45}, {45, 44.99999}}) {
    const SpotLight light(Vec3d::Zero(), Vec3d(1, 2, 3), Spectrum::Ones(), cone);
    const int steps = 100'000;
    double sum = 0;
    const double c = cone.cutoff * mc::pi<double> / 180, b = cone.beam * mc::pi<double> / 180;
    for (int i = 0; i < steps; ++i) {
      const double angle = (i + 0.5) / steps * c;
      sum += (angle <= b ? 1 : (c - angle) / (c - b)) * std::sin(angle);
    }
    const double expected = 2 * mc::pi<double> * sum * c / steps;
    EXPECT_NEAR(light.power(1) / expected, 1, 1e-6) << cone.cutoff << " " << cone.beam;
  }
}

TEST(SpotLight, IsADeltaLight) {
  const SpotLight light(Vec3d::Zero(), Vec3d::UnitZ(), Spectrum::Ones(), {});
  EXPECT_TRUE(light.is_delta() && light.is_sampled() && !light.is_infinite());
  EXPECT_TRUE(is_black(light.Le(Vec3::UnitZ(), nullptr)));
  EXPECT_EQ(light.pdf(Vec3::Zero(), Vec3::UnitZ(), nullptr), 0);
  EXPECT_FALSE(light.sample(Vec3::Zero(), {})) << "there is no direction toward the light at its position";
}

TEST(SpotLight, RefusesNonsense) {
  const auto error = [](const Vec3d& position, const Vec3d& axis, Float intensity, const SpotLight::Cone& cone) {
    return support::error_of([&] { SpotLight(position, axis, Spectrum::Constant(intensity), cone); });
  };
  const double inf = mc::infinity<double>;
  EXPECT_THAT(error({inf, 0, 0}, Vec3d::UnitZ(), 1, {}), testing::HasSubstr("position (inf, 0, 0) must be finite"));
  EXPECT_THAT(error(Vec3d::Zero(), Vec3d::Zero(), 1, {}), testing::HasSubstr("axis (0, 0, 0) must be finite and not"));
  EXPECT_THAT(error(Vec3d::Zero(), Vec3d::UnitZ(), -1, {}), testing::HasSubstr("intensity (-1, -1, -1) must be"));
  EXPECT_THAT(error(Vec3d::Zero(), Vec3d::UnitZ(), 1, {0, 0}), testing::HasSubstr("cutoff angle 0 must lie in"));
  EXPECT_THAT(error(Vec3d::Zero(), Vec3d::UnitZ(), 1, {181, 0}), testing::HasSubstr("cutoff angle 181 must lie in"));
  EXPECT_THAT(error(Vec3d::Zero(), Vec3d::UnitZ(), 1, {20, 21}), testing::HasSubstr("beam width 21 must lie in"));
  for (const SpotLight::Cone& bad : {SpotLight::Cone{std::nan(""), 0}, {20, std::nan("")}})
    EXPECT_THROW(SpotLight(Vec3d::Zero(), Vec3d::UnitZ(), Spectrum::Ones(), bad), mc::Error);
}

} // namespace
