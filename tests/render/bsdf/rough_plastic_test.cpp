#include <render/bsdf/dielectric.h>
#include <render/bsdf/rough_dielectric.h>
#include <render/bsdf/rough_plastic.h>

#include <mc/check/bsdf_laws.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

RoughPlastic<> plastic(double alpha) {
  return RoughPlastic(Float(1.49), Float(alpha), Spectrum(Float(0.1), Float(0.5), Float(0.3)), Spectrum::Ones());
}
template <class Base = LayeredBase> RoughPlastic<Base> white(double eta, double alpha) {
  return RoughPlastic<Base>(Float(eta), Float(alpha), Spectrum::Ones(), Spectrum::Ones());
}
double log_uniform(mc::Pcg& random, double low, double high) {
  return low * std::pow(high / low, random.uniform<double>());
}
Vec3 upper(mc::Pcg& random) {
  const double z = log_uniform(random, 1e-4, 1), turn = 6.283 * random.uniform<double>(), r = std::sqrt(1 - z * z);
  return Vec3d(r * std::cos(turn), r * std::sin(turn), z).cast<Float>();
}

// Directions on both sides at alpha = 1e-5 each.
TEST(RoughPlastic, ObeysTheLawsWithBeckmannFacets) {
  for (const double alpha : {1e-4, 0.3})
    for (const double angle : {0.0, 85.0, 120.0}) {
      const RoughPlastic<LayeredBase, BeckmannFacets> paint(Float(1.49), Float(alpha), Spectrum::Constant(Float(0.5)),
                                                            Spectrum::Ones());
      const auto report =
          mc::check_bsdf<Float>(paint, support::at_degrees(angle), {.statistics = {.samples = 50'000, .alpha = 1e-5}});
      EXPECT_TRUE(report.passed()) << alpha << ", " << angle << " degrees\n" << report.to_string();
    }
}

TEST(RoughPlastic, ObeysTheLaws) {
  for (const double alpha : {1e-4, 1e-3, 0.02, 0.3, 1.0})
    for (const double angle : {0.0, 60.0, 85.0, 120.0}) {
      const Vec3 wo = support::at_degrees(angle);
      const auto report = mc::check_bsdf<Float>(plastic(alpha), wo, {.statistics = {.samples = 50'000, .alpha = 1e-5}});
      EXPECT_TRUE(report.passed()) << alpha << ", " << angle << " degrees\n" << report.to_string();
    }
}

// The bound is five standard errors plus 3e-4 for the table.
TEST(RoughPlastic, ConservesEnergy) {
  mc::Pcg random(11);
  for (int k = 0; k < 200; ++k) {
    const double eta = k % 5 ? log_uniform(random, 1.0001, 4) : log_uniform(random, 0.3, 1);
    const double alpha = log_uniform(random, 1e-4, 1);
    const RoughPlastic paint = white(eta, alpha);
    const Vec3 wo = upper(random);
    mc::Moments leaves;
    for (int i = 0; i < 4000; ++i) {
      const Float uc = random.uniform<Float>(), u0 = random.uniform<Float>(), u1 = random.uniform<Float>();
      const auto s = paint.sample(wo, uc, Vec2(u0, u1));
      leaves.add(s ? double(s->f[1] * s->wi.z() / s->pdf) : 0.0);
    }
    EXPECT_LE(leaves.mean(), 1 + 5 * leaves.std_error() + 3e-4) << eta << ", " << alpha << ", " << wo.transpose();
  }
}

TEST(RoughPlastic, IsTheSameBothWays) {
  mc::Pcg random(12);
  for (int k = 0; k < 20; ++k) {
    const double eta = log_uniform(random, 0.5, 3);
    const RoughPlastic paint = white(eta, log_uniform(random, 1e-4, 1));
    for (int i = 0; i < 50; ++i) {
      const Vec3 a = upper(random), b = upper(random);
      const Float there = paint.eval(a, b)[0], back = paint.eval(b, a)[0];
      EXPECT_NEAR(there, back, 1e-4 * there) << eta << ", " << a.transpose() << ", " << b.transpose();
    }
  }
}

// Away from the mirror direction the value is T(wo) T(wi) / (pi mean T) of the smooth coat. Its hemispherical
// reflectance at eta = 1.5 is .0917780. White paint loses nothing.
TEST(RoughPlastic, TendsToTheSmoothOne) {
  const RoughPlastic paint = white(1.5, 1e-4);
  const auto through = [](Float cosine) { return 1 - double(fresnel_dielectric(cosine, Float(1.5)).reflectance); };
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 85.0, 88.0, 89.0}) {
    const Vec3 wo = support::at_degrees(degrees), wi = Vec3(Float(0.3), Float(-0.5), Float(0.4)).normalized();
    const double smooth = through(wo.z()) * through(wi.z()) / (mc::pi<double> * (1 - 0.0917780));
    EXPECT_NEAR(paint.eval(wo, wi)[0], smooth, 0.001 * smooth) << degrees;
    EXPECT_NEAR(support::albedo(paint, std::cos(degrees * mc::pi<double> / 180)), 1, 5e-4) << degrees;
  }
}

// Directional albedos of the coat alone for the relative index 1.49. They are from an independent quadrature and 4e5
// samples of another program, +- .0005.
TEST(RoughPlastic, DirectionalAlbedos) {
  struct Row {
    double alpha, at_09, at_05, at_02;
  };
  for (const Row& row : {Row{0.1, 0.0395, 0.0842, 0.2341}, Row{0.3, 0.0357, 0.0593, 0.1099},
                         Row{0.6, 0.0246, 0.0358, 0.0572}, Row{1, 0.0133, 0.0203, 0.0321}}) {
    const RoughPlastic coat(Float(1.49), Float(row.alpha), Spectrum::Zero(), Spectrum::Ones());
    EXPECT_NEAR(support::albedo(coat, 0.9), row.at_09, 0.0008) << row.alpha;
    EXPECT_NEAR(support::albedo(coat, 0.5), row.at_05, 0.0008) << row.alpha;
    EXPECT_NEAR(support::albedo(coat, 0.2), row.at_02, 0.0008) << row.alpha;
  }
}

// The gain of energy that the header describes, and its detection by the laws.
TEST(LajollaBase, GainsTowardsTheHorizon) {
  EXPECT_NEAR(support::albedo(white<LajollaBase>(1.49, 1e-4), std::cos(89.9 * mc::pi<double> / 180)), 1.84, 0.02);
  for (const double alpha : {1e-4, 0.02, 0.1})
    EXPECT_GE(support::albedo(white<LajollaBase>(1.49, alpha), std::cos(70 * mc::pi<double> / 180)), 1.03) << alpha;
  const RoughPlastic<LajollaBase> paint(Float(1.49), Float(0.02), Spectrum::Constant(Float(0.5)), Spectrum::Ones());
  const auto report = mc::check_bsdf<Float>(paint, Vec3(0, 0, 1), {.statistics = {.samples = 50'000, .alpha = 1e-5}});
  EXPECT_EQ(report.fault(), mc::Fault::physics) << report.to_string();
}

// Boundaries of every kind, with directions down to the horizon, on both sides.
TEST(RelativeIndex, SamplesAreFiniteAtItsEnds) {
  const auto check = [](const auto& bsdf, Float eta) {
    mc::Pcg random(5);
    for (int i = 0; i < 5000; ++i) {
      const Float cosine = std::pow(Float(10), -4 * random.uniform<Float>()) * Float(i % 2 ? 1 : -1);
      const auto s = bsdf.sample(mc::spherical_direction<Float>(std::sqrt(1 - cosine * cosine), cosine, Float(i)),
                                 random.uniform<Float>(), random.point<Float, 2>());
      if (!s) continue;
      EXPECT_NEAR(s->wi.norm(), 1, 1e-5) << eta;
      EXPECT_TRUE(s->f.isFinite().all() && std::isfinite(s->pdf) && s->pdf > 0) << eta << " at cosine " << cosine;
    }
  };
  const Spectrum one = Spectrum::Ones();
  for (const Float eta : {Float(1e-3), Float(1e3)}) {
    check(Dielectric(eta), eta);
    for (const Float alpha : {Float(1e-4), Float(0.1), Float(1)}) {
      check(RoughDielectric(eta, alpha), eta);
      check(RoughPlastic(eta, alpha, one, one), eta);
    }
  }
}

TEST(RoughPlastic, RefusesNonsense) {
  const Spectrum one = Spectrum::Ones();
  EXPECT_THROW(RoughPlastic(0, Float(0.1), one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), 0, one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), Float(0.1), 2 * one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), Float(0.1), one, -one), mc::Error);
}

} // namespace
