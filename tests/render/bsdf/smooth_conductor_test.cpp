#include <render/bsdf/smooth_conductor.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/bsdf/roughness_limit.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

namespace {

using namespace render;

const Spectrum copper(Float(0.2), Float(0.92), Float(1.1)), copper_k(Float(3.9), Float(2.45), Float(2.14));

TEST(SmoothConductor, IsAMirrorByFresnel) {
  const SmoothConductor metal(copper, copper_k, Spectrum::Constant(Float(0.5)));
  for (const double angle : {0.0, 60.0, 89.0, 120.0}) {
    const Vec3 wo = support::at_degrees(angle);
    const Float cosine = std::abs(wo.z());
    const auto s = metal.sample(wo, Float(0.3), Vec2(Float(0.1), Float(0.7)));
    ASSERT_TRUE(s && s->delta) << angle;
    EXPECT_EQ(s->wi, Vec3(-wo.x(), -wo.y(), wo.z()));
    const Spectrum weight = s->f * cosine / s->pdf;
    EXPECT_LE((weight - fresnel_conductor(cosine, copper, copper_k) / 2).abs().maxCoeff(), 1e-6) << angle;
    EXPECT_TRUE((metal.eval(wo, s->wi) == 0).all());
    EXPECT_EQ(metal.pdf(wo, s->wi), 0);
  }
  EXPECT_FALSE(metal.sample(Vec3(1, 0, 0), Float(0.3), Vec2(Float(0.1), Float(0.7))));
}

// Four directions at alpha = 1e-5 each.
TEST(SmoothConductor, ObeysTheLaws) {
  for (const double angle : {0.0, 60.0, 89.9, 120.0}) {
    const auto report = mc::check_bsdf<Float>(SmoothConductor(copper, copper_k), support::at_degrees(angle),
                                              {.statistics = {.samples = 20'000, .alpha = 1e-5}});
    EXPECT_TRUE(report.passed()) << angle << " degrees\n" << report.to_string();
  }
}

template <class Facets> void expect_metal_tends_to_it() {
  const auto rough = [](Float alpha) {
    return RoughConductor<Facets>(copper, copper_k, Facets(std::max(alpha, Float(1e-4))));
  };
  for (const double angle : {0.0, 45.0, 70.0, 120.0})
    for (const mc::Check& c :
         mc::check_roughness_limit<Float>(rough, SmoothConductor(copper, copper_k), support::at_degrees(angle)))
      EXPECT_EQ(c.verdict, mc::Verdict::pass) << angle << " " << c.name << ": " << c.detail;
}

TEST(SmoothConductor, IsWhatRoughMetalTendsTo) {
  expect_metal_tends_to_it<TrowbridgeReitzFacets>();
  expect_metal_tends_to_it<BlinnPhongFacets>();
}

TEST(SmoothConductor, RefusesNonsense) {
  EXPECT_EQ(support::error_of([] { SmoothConductor(Spectrum::Zero(), Spectrum::Zero()); }),
            "conductor: eta (0, 0, 0) and k must not both be 0");
  EXPECT_EQ(support::error_of([] { SmoothConductor(copper, copper_k, Spectrum::Constant(2)); }),
            "conductor: specularReflectance (2, 2, 2) must lie in [0, 1]");
}

} // namespace
