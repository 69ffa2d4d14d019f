// Checks of HazySun: its samples, and the light that it sheds.
#include "direct_light.h"
#include "hazy_sun.h"

#include <mc/domain/sphere.h>
#include <mc/gtest/matchers.h>

using namespace render;

const Vec3 up = Vec3::UnitY(), low = Vec3(1, 1, 0).normalized();

struct Sample {
  Vec3 x;
  Float pdf;
  Spectrum weight;
};

// sample, pdf and radiance of a light as a distribution of directions: weight = Le / pdf.
template <LightLike L> mc::AnyDistribution directions_to(const L& light) {
  const Vec3 ref = Vec3::Zero();
  return mc::make_distribution(
      "light", mc::Sphere<Float>(),
      [=](const Vec2& u) {
        const LightSample s = *light.sample(ref, u);
        return Sample{s.wi, s.pdf, s.radiance / s.pdf};
      },
      [=](const Vec3& wi) { return light.pdf(ref, wi, nullptr); },
      [=](const Vec3& wi) { return light.Le(wi, nullptr); });
}

struct ForgottenRotation : HazySun {
  using HazySun::HazySun;
  Float pdf(const Vec3&, const Vec3& wi, const SurfacePoint*) const { return mc::VonMisesFisher<Float>(40).pdf(wi); }
};

const mc::LawOptions quick{.statistics = {.samples = 100'000}};

TEST(HazySun, ObeysItsLaws) {
  const mc::Report report = mc::check_laws(directions_to(HazySun(low, 40, {3, 2, 1})), quick);
  EXPECT_TRUE(report.passed()) << report;
}

TEST(HazySun, WrongDensityIsFound) {
  const mc::Report report = mc::check_laws(directions_to(ForgottenRotation(low, 40, {3, 2, 1})), quick);
  EXPECT_EQ(report.verdict(), mc::Verdict::fail) << report;
}

// A narrow sun overhead lights the ground, of albedo 1/2, like parallel light.
TEST(HazySun, TechniquesAgree) {
  const Scene scene = sphere_on_ground();
  const HazySun sun(up, 1e5f, {3, 2, 1}), haze(low, 5, {3, 2, 1});
  const Ray down{Vec3(5, 1, 5), -up}, beside{Vec3(-1.5f, 1, 0), -up};
  mc::Pcg random(1);
  const auto radiances = [&](const HazySun& light, const Ray& ray, Technique t, int n = 10'000) {
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(double(direct_light(scene, light, ray, random, t)[0]));
    return values;
  };
  EXPECT_NEAR(radiances(sun, down, Technique::light, 1)[0], 1.5 / mc::pi<double>, 1e-4);
  mc::Moments by_light;
  for (const double x : radiances(haze, beside, Technique::light, 200'000)) by_light.add(x);
  EXPECT_MEAN(radiances(haze, beside, Technique::bsdf), by_light.mean());
  EXPECT_MEAN(radiances(haze, beside, Technique::mis), by_light.mean());
}
