#include <render/bsdf/lambert.h>

#include <mc/check/bsdf_laws.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// Five directions at alpha = 1e-5 each: a correct BSDF fails for one seed in 20000. The seed is fixed.
TEST(Lambert, ObeysTheLawsOnBothSides) {
  const Lambert white{Spectrum::Ones()};
  for (const double angle : {0.0, 45.0, 89.9, 100.0, 180.0}) {
    const double theta = angle * mc::pi<double> / 180;
    const Vec3 wo = Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>();
    const auto report = mc::check_bsdf<Float>(white, wo, {.statistics = {.samples = 50'000, .alpha = 1e-5}});
    EXPECT_TRUE(report.passed()) << angle << " degrees\n" << report.to_string();
  }
}

TEST(Lambert, ReflectsItsAlbedoAndTransmitsNothing) {
  const Lambert b{Spectrum(Float(0.1), Float(0.5), Float(0.9))};
  const Vec3 wo = Vec3(1, 0, 1).normalized(), wi = Vec3(0, 1, 2).normalized();
  for (int c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(b.eval(wo, wi)[c], b.albedo()[c] / mc::pi<Float>);
    EXPECT_EQ(b.eval(wo, -wi)[c], 0);
    EXPECT_EQ(b.eval(-wo, -wi)[c], b.eval(wo, wi)[c]);
  }
  EXPECT_EQ(b.pdf(wo, -wi), 0);
  EXPECT_FALSE(b.lobes().is_delta());
}

TEST(Lambert, RefusesNonsense) {
  for (const Float bad : {Float(-0.1), Float(1.1), std::numeric_limits<Float>::quiet_NaN()})
    EXPECT_THROW(Lambert(Spectrum(1, bad, 1)), mc::Error);
}

// The book's bug of points in the ball has E[cos] = .8 ([Shirley16], ch. 4). The midpoint rule over n x n points has
// the error O(n^-1.5), since the cosine is a square root at the horizon.
TEST(Lambert, MeanCosineIsTwoThirds) {
  const int n = 256;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += Lambert{}.sample(Vec3::UnitZ(), 0, Vec2((Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n))->wi.z();
  EXPECT_NEAR(sum / (n * n), 2.0 / 3, std::pow(n, -1.5));
}

} // namespace
