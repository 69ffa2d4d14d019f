#include <render/light/light_sampler.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;

Vec3d random_vector(mc::Pcg& random) {
  return {random.uniform<double>() - 0.5, random.uniform<double>() - 0.5, random.uniform<double>() - 0.5};
}

// The inverse square law at any scale, up to rounding of the reference point and of the result.
TEST(PointLight, FallsWithTheSquareOfTheDistance) {
  mc::Pcg random(11);
  for (const double scale : {1e-15, 1e-6, 1.0, 1e6, 1e15})
    for (int i = 0; i < 200; ++i) {
      const Vec3d at = scale * random_vector(random);
      const Vec3 ref = (scale * random_vector(random)).cast<Float>();
      const Vec3d way = at - ref.cast<double>();
      const Spectrum intensity = Spectrum(1, 2, 3) * Float(scale * scale);
      const PointLight light(at, intensity);
      const auto s = light.sample(ref, Vec2(Float(0.3), Float(0.7)));
      ASSERT_TRUE(s && s->point);
      EXPECT_EQ(s->pdf, 1);
      EXPECT_LE((s->wi.cast<double>() - way.normalized()).norm(), 1e-6);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double(s->radiance[c]) / (scale * scale * (c + 1) / way.squaredNorm()), 1, 1e-6) << scale;
      EXPECT_NEAR(light.irradiance(ref) / double(luminance(s->radiance)), 1, 1e-6);
    }
}

TEST(PointLight, Power) {
  EXPECT_NEAR(PointLight(Vec3d::Zero(), Spectrum::Constant(3)).power(1), 12 * mc::pi<double>, 1e-5);
}

// At the position of the light there is no direction toward it, and its weight stays finite.
TEST(PointLight, AtItsOwnPlace) {
  const std::vector<Light> lights = {PointLight(Vec3d(1, 2, 3), Spectrum::Ones()),
                                     PointLight(Vec3d(1, 2, 4), Spectrum::Constant(1e30f)),
                                     PointLight(Vec3d(1, 2, 3), Spectrum::Zero())};
  const Vec3 there(1, 2, 3);
  EXPECT_FALSE(lights[0].sample(there, Vec2(0, 0)));
  const auto choice = LightSampler::create(lights, 1);
  ASSERT_TRUE(choice);
  EXPECT_NEAR(choice->pmf(lights, there, 0), 5.0 / 6, 1e-6);
  EXPECT_NEAR(choice->pmf(lights, there, 1), 1.0 / 6, 1e-6);
  EXPECT_EQ(choice->pmf(lights, there, 2), 0) << "it is dark";
}

TEST(DirectionalLight, IsTheSameEverywhere) {
  for (const double length : {1e-200, 1.0, 1e200}) {
    const DirectionalLight sun(length * Vec3d(1, -2, 2), Spectrum(1, 2, 3));
    for (const Vec3& ref : {Vec3(0, 0, 0), Vec3(1e20f, 0, 0)}) {
      const auto s = sun.sample(ref, Vec2(Float(0.3), Float(0.7)));
      ASSERT_TRUE(s);
      EXPECT_FALSE(s->point);
      EXPECT_EQ(s->pdf, 1);
      EXPECT_LE((s->wi - Vec3(-1, 2, -2) / 3).norm(), 1e-6);
      EXPECT_TRUE((s->radiance == Spectrum(1, 2, 3)).all());
    }
  }
  EXPECT_NEAR(DirectionalLight(Vec3d::UnitX(), Spectrum::Constant(2)).power(3), 18 * mc::pi<double>, 1e-4);
}

TEST(DeltaLights, AreNeverHitByRays) {
  SurfacePoint met;
  met.ng = Vec3::UnitY();
  for (const Light& light : {Light(PointLight(Vec3d::Zero(), Spectrum::Ones())),
                             Light(DirectionalLight(Vec3d::UnitZ(), Spectrum::Ones()))}) {
    EXPECT_TRUE(light.is_delta() && light.is_sampled() && !light.is_infinite());
    for (const SurfacePoint* p : std::initializer_list<const SurfacePoint*>{&met, nullptr}) {
      EXPECT_TRUE(is_black(light.Le(Vec3::UnitX(), p)));
      EXPECT_EQ(light.pdf(Vec3::Zero(), Vec3::UnitX(), p), 0);
    }
  }
}

TEST(DeltaLights, RefuseNonsense) {
  const Float nan = std::numeric_limits<Float>::quiet_NaN();
  for (const Float bad : {Float(-1), nan, mc::infinity<Float>}) {
    EXPECT_THROW(PointLight(Vec3d::Zero(), Spectrum(1, bad, 1)), mc::Error);
    EXPECT_THROW(DirectionalLight(Vec3d::UnitX(), Spectrum(1, bad, 1)), mc::Error);
  }
  for (const Vec3d& bad : {Vec3d(double(nan), 0, 0), Vec3d(mc::infinity<double>, 0, 0)}) {
    EXPECT_THROW(PointLight(bad, Spectrum::Ones()), mc::Error);
    EXPECT_THROW(DirectionalLight(bad, Spectrum::Ones()), mc::Error);
  }
  EXPECT_THAT(support::error_of([] { DirectionalLight(Vec3d::Zero(), Spectrum::Ones()); }),
              testing::HasSubstr("direction (0, 0, 0) must be finite and not 0"));
}

} // namespace
