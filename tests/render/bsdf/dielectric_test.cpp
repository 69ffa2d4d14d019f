#include <render/bsdf/dielectric.h>

#include <mc/check/bsdf_laws.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, Float(1.5)).reflectance, 0.04, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(1, Float(1 / 1.5)).reflectance, 0.04, 1e-6);
  EXPECT_EQ(fresnel_dielectric(Float(0.5), 1).reflectance, 0);
  EXPECT_NEAR(fresnel_dielectric(Float(1e-6), Float(1.5)).reflectance, 1, 1e-4);
  // Leaving glass at 40 degrees, just below the critical angle of 41.81 (course Introduction to Real-Time Ray Tracing,
  // SIGGRAPH 2019, ch. 8).
  EXPECT_NEAR(fresnel_dielectric(Float(std::cos(40 * mc::pi<double> / 180)), Float(1 / 1.5)).reflectance, 0.245, 5e-4);
  const auto total = fresnel_dielectric(Float(std::cos(42 * mc::pi<double> / 180)), Float(1 / 1.5));
  EXPECT_EQ(total.reflectance, 1);
  EXPECT_EQ(total.cos_t, 0);
}

// The hemispherical reflectance of glass, 2 int R cos dcos, in closed form. Schlick's approximation with the wrong
// cosine fails this test.
TEST(Fresnel, HemisphericalReflectance) {
  const int n = 100'000;
  double outside = 0, inside = 0;
  for (int i = 0; i < n; ++i) {
    const double c = (i + 0.5) / n;
    outside += 2 * c * double(fresnel_dielectric(Float(c), Float(1.5)).reflectance) / n;
    inside += 2 * c * double(fresnel_dielectric(Float(c), Float(1 / 1.5)).reflectance) / n;
  }
  EXPECT_NEAR(outside, 0.091777959342, 2e-6);
  EXPECT_NEAR(inside, 0.59635, 1e-5);
}

// The refracted cosine leads back to cos_i up to one ulp of sin^2, which is eps eta^2 / cos_i. R is steep there:
// dR/dcos| <= 6.
TEST(Fresnel, TheSameFromBothSides) {
  for (int i = 1; i <= 100; ++i) {
    const Float cos_i = Float(i) / 100;
    const auto in = fresnel_dielectric(cos_i, Float(1.5));
    EXPECT_NEAR(fresnel_dielectric(in.cos_t, 1 / Float(1.5)).reflectance, in.reflectance, 1e-6 / cos_i) << cos_i;
  }
}

// Probabilities of the lobes, reciprocity across the surface and energy, for five directions at alpha = 1e-5 each.
TEST(Dielectric, ObeysTheLawsOnBothSides) {
  for (const double angle : {0.0, 60.0, 89.9, 130.0, 150.0}) {
    const double theta = angle * mc::pi<double> / 180;
    const Vec3 wo = Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>();
    const auto report =
        mc::check_bsdf<Float>(Dielectric{}, wo, {.statistics = {.samples = 50'000, .alpha = 1e-5}, .eta = 1.5});
    EXPECT_TRUE(report.passed()) << angle << " degrees\n" << report.to_string();
  }
}

TEST(Dielectric, RefractsBySnellsLaw) {
  for (int i = 0; i < 180; ++i) {
    const double theta = (i + 0.5) * mc::pi<double> / 180;
    const Vec3 wo = Vec3d(std::sin(theta) * 0.6, std::sin(theta) * 0.8, std::cos(theta)).cast<Float>();
    const auto s = Dielectric{}.sample(wo, mc::one_minus_epsilon<Float>, Vec2::Zero());
    ASSERT_TRUE(s.has_value());
    if (s->eta == 1) { // total internal reflection
      EXPECT_GE(theta, 90 * mc::pi<double> / 180) << i;
      EXPECT_LE(theta, (180 - 41.81) * mc::pi<double> / 180) << i;
      continue;
    }
    const Float n_o = wo.z() > 0 ? 1 : Float(1.5), n_i = wo.z() > 0 ? Float(1.5) : 1;
    EXPECT_NEAR(s->eta, n_i / n_o, 1e-6) << i;
    EXPECT_LE((n_o * wo.head<2>() + n_i * s->wi.head<2>()).norm(), 2e-6) << i;
    EXPECT_LE(wo.z() * s->wi.z(), 0) << i;
    EXPECT_NEAR(s->wi.norm(), 1, 1e-6) << i;
  }
}

TEST(Dielectric, RefusesNonsense) {
  const Float nan = std::numeric_limits<Float>::quiet_NaN();
  for (const Float bad : {Float(0), Float(-1), Float(1e-30), Float(1e30), nan, mc::infinity<Float>})
    EXPECT_THROW(Dielectric{bad}, mc::Error);
  for (const Float bad : {Float(-0.1), Float(1.1), nan}) {
    EXPECT_THROW(Dielectric(1, Spectrum(1, bad, 1)), mc::Error);
    EXPECT_THROW(Dielectric(1, Spectrum::Ones(), Spectrum(1, bad, 1)), mc::Error);
  }
}

TEST(Dielectric, IndexOne_TransmitsUnchanged) {
  const Vec3 wo = Vec3(1, 2, 3).normalized();
  const auto s = Dielectric{1}.sample(wo, 0, Vec2::Zero());
  ASSERT_TRUE(s.has_value());
  EXPECT_LE((s->wi + wo).norm(), 1e-6);
  EXPECT_NEAR(s->f[0] * std::abs(s->wi.z()) / s->pdf, 1, 1e-6);
}

} // namespace
