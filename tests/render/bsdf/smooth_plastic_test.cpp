#include <render/bsdf/smooth_plastic.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/bsdf/roughness_limit.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

namespace {

using namespace render;

const Spectrum green_base(Float(0.1), Float(0.5), Float(0.3)), all_light = Spectrum::Ones();

// Directions on both sides at alpha = 1e-5 each: probability and energy of the coat's lobe, and the base.
TEST(SmoothPlastic, ObeysTheLaws) {
  for (const double eta : {1.49, 0.7})
    for (const double angle : {0.0, 60.0, 85.0, 89.9, 120.0}) {
      const auto report =
          mc::check_bsdf<Float>(SmoothPlastic(Float(eta), green_base, all_light), support::at_degrees(angle),
                                {.statistics = {.samples = 50'000, .alpha = 1e-5}});
      EXPECT_TRUE(report.passed()) << eta << ", " << angle << " degrees\n" << report.to_string();
    }
}

template <class Base> void expect_paint_tends_to_it() {
  const auto rough = [](Float alpha) {
    return RoughPlastic<Base>(Float(1.49), std::max(alpha, Float(1e-4)), green_base, all_light);
  };
  const SmoothPlastic<Base> smooth(Float(1.49), green_base, all_light);
  for (const double angle : {0.0, 45.0, 70.0, 120.0})
    for (const mc::Check& c : mc::check_roughness_limit<Float>(rough, smooth, support::at_degrees(angle)))
      EXPECT_EQ(c.verdict, mc::Verdict::pass) << angle << " " << c.name << ": " << c.detail;
}

TEST(SmoothPlastic, IsWhatRoughPlasticTendsTo) {
  expect_paint_tends_to_it<LayeredBase>();
  expect_paint_tends_to_it<LajollaBase>();
}

// The coat follows Fresnel's equations and the base T(wo) T(wi) / (pi mean T). The hemispherical reflectance of the
// coat at eta = 1.5 is .0917780. White paint loses nothing.
TEST(SmoothPlastic, IsThatOfTheFormulas) {
  const SmoothPlastic paint(Float(1.5), all_light, all_light);
  const auto through = [](Float cosine) { return 1 - double(fresnel_dielectric(cosine, Float(1.5)).reflectance); };
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0, 150.0}) {
    const Vec3 wo = support::at_degrees(degrees);
    const Vec3 wi = Vec3(Float(0.3), Float(-0.5), std::copysign(Float(0.4), wo.z())).normalized();
    const double base = through(std::abs(wo.z())) * through(std::abs(wi.z())) / (mc::pi<double> * (1 - 0.0917780));
    EXPECT_NEAR(paint.eval(wo, wi)[0], base, 0.001 * base) << degrees;
    EXPECT_EQ(paint.eval(wo, -wi)[0], 0) << degrees;
    const auto s = paint.sample(wo, 0, Vec2(Float(0.2), Float(0.6)));
    ASSERT_TRUE(s && s->delta) << degrees;
    EXPECT_EQ(s->wi, Vec3(-wo.x(), -wo.y(), wo.z()));
    EXPECT_NEAR(double(s->f[0]) * std::abs(double(wo.z())), 1 - through(std::abs(wo.z())), 1e-6) << degrees;
    if (degrees < 90) {
      EXPECT_NEAR(support::albedo(paint, std::cos(degrees * mc::pi<double> / 180)), 1, 1e-3) << degrees;
    }
  }
}

TEST(SmoothPlastic, BlackLobesAreNotSampled) {
  const Vec3 wo = support::at_degrees(50);
  const SmoothPlastic untextured(Float(1.5), Spectrum::Zero(), all_light),
      matt(Float(1.5), all_light, Spectrum::Zero());
  for (const Float uc : {Float(0), Float(0.5), mc::one_minus_epsilon<Float>}) {
    EXPECT_TRUE(untextured.sample(wo, uc, Vec2(Float(0.3), Float(0.3)))->delta) << uc;
    EXPECT_FALSE(matt.sample(wo, uc, Vec2(Float(0.3), Float(0.3)))->delta) << uc;
  }
}

TEST(SmoothPlastic, RefusesNonsense) {
  EXPECT_EQ(support::error_of([] { SmoothPlastic(Float(0), green_base, all_light); }),
            "plastic: relative index 0 must lie in [0.001, 1000]");
  EXPECT_THAT(support::error_of([] { SmoothPlastic(Float(1.5), 2 * all_light, all_light); }),
              testing::HasSubstr("plastic: diffuseReflectance (2, 2, 2) must lie in [0, 1]"));
  EXPECT_THAT(support::error_of([] { SmoothPlastic(Float(1.5), green_base, -all_light); }),
              testing::HasSubstr("plastic: specularReflectance (-1, -1, -1) must lie in [0, 1]"));
}

// The base and the inside of the coat reflect light in turn: rho (1 + rho F + (rho F)^2 + ...). A white base returns
// all light. With linear reflections, F counts for every colour as for white.
TEST(SmoothPlastic, NonlinearReflectionsTakeTheColourEachTime) {
  for (const double eta : {1.3, 1.49, 1.9}) {
    double inside = 0; // reflectance of the coat for diffuse light from inside
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double cosine = (i + 0.5) / n;
      inside += 2 * cosine * double(fresnel_dielectric(Float(cosine), Float(1 / eta)).reflectance) / n;
    }
    const SmoothPlastic<> linear(Float(eta), green_base, all_light),
        nonlinear(Float(eta), green_base, all_light, InternalReflections::nonlinear),
        white(Float(eta), all_light, all_light, InternalReflections::nonlinear);
    const Vec3 wo = support::at_degrees(30), wi = support::at_degrees(-50);
    for (int c = 0; c < 3; ++c) {
      const double rho = double(green_base[c]), series = rho / (1 - rho * inside), white_series = rho / (1 - inside);
      EXPECT_NEAR(nonlinear.eval(wo, wi)[c] / linear.eval(wo, wi)[c], series / white_series, 2e-3) << eta << " " << c;
    }
    EXPECT_NEAR(support::albedo(white, 0.7), 1, 1e-3) << eta;
    const auto report = mc::check_bsdf<Float>(nonlinear, wo, {.statistics = {.samples = 50'000, .alpha = 1e-5}});
    EXPECT_TRUE(report.passed()) << report.to_string();
    SmoothPlastic repainted = white;
    for (int times = 1; times <= 2; ++times) {
      repainted.set_diffuse_reflectance(green_base);
      EXPECT_TRUE(repainted.eval(wo, wi).isApprox(nonlinear.eval(wo, wi))) << times;
    }
  }
}

} // namespace
