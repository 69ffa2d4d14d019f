#include <render/bsdf/bsdf.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

static_assert(BsdfLike<Lambert> && BsdfLike<FuzzyMetal> && BsdfLike<Dielectric> && BsdfLike<RoughPlastic<>> &&
              BsdfLike<RoughPlastic<LajollaBase>> && BsdfLike<RoughDielectric<>> &&
              BsdfLike<RoughConductor<TrowbridgeReitzFacets>> && BsdfLike<RoughConductor<BlinnPhongFacets>> &&
              BsdfLike<SmoothPlastic<>> && BsdfLike<SmoothPlastic<LajollaBase>> && BsdfLike<SmoothConductor> &&
              BsdfLike<Bsdf>);

TEST(Bsdf, ForwardsToItsAlternative) {
  const FuzzyMetal metal{Spectrum::Constant(Float(0.7)), Float(0.5)};
  const Bsdf bsdf = metal;
  const Vec3 wo = Vec3(1, 0, 2).normalized(), wi = Vec3(-1, Float(0.1), 2).normalized();
  const Vec2 u(Float(0.2), Float(0.6));
  EXPECT_EQ(bsdf.pdf(wo, wi), metal.pdf(wo, wi));
  EXPECT_TRUE((bsdf.eval(wo, wi) == metal.eval(wo, wi)).all());
  EXPECT_EQ(bsdf.eta(wo, -wi), 1);
  EXPECT_EQ(Bsdf(RoughDielectric(Float(1.5), Float(0.1))).eta(wo, -wi), Float(1.5));
  EXPECT_EQ(bsdf.sample(wo, Float(0.5), u)->wi, metal.sample(wo, Float(0.5), u)->wi);
  EXPECT_FALSE(bsdf.lobes().is_delta());
  EXPECT_TRUE(Bsdf(Dielectric{}).lobes().is_delta());
  EXPECT_TRUE(Bsdf(FuzzyMetal{}).lobes().is_delta());
  EXPECT_TRUE(Bsdf(SmoothConductor(Spectrum::Ones(), Spectrum::Ones())).lobes().is_delta());
  const Bsdf lacquer = SmoothPlastic(Float(1.5), Spectrum::Ones(), Spectrum::Ones());
  EXPECT_TRUE(lacquer.lobes().has_delta && !lacquer.lobes().is_delta() && !lacquer.lobes().is_near_specular());
  EXPECT_FALSE(Bsdf(Lambert{}).lobes().is_delta());
}

// Rough glass focuses light at any roughness, reflection only up to a roughness of .2, which is a fuzz of .5.
TEST(Lobes, CastCausticsIfNarrow) {
  const Spectrum one = Spectrum::Ones();
  const auto metal = [&](Float alpha) { return Bsdf(RoughConductor(one, one, TrowbridgeReitzFacets(alpha))).lobes(); };
  const auto fuzzy = [&](Float fuzz) { return Bsdf(FuzzyMetal(one, fuzz)).lobes(); };
  EXPECT_TRUE(metal(Float(0.2)).casts_caustics() && fuzzy(Float(0.5)).casts_caustics());
  EXPECT_FALSE(metal(Float(0.21)).casts_caustics() || fuzzy(Float(0.51)).casts_caustics());
  EXPECT_TRUE(Bsdf(RoughDielectric(Float(1.5), 1)).lobes().casts_caustics());
  EXPECT_FALSE(Bsdf(Lambert{}).lobes().casts_caustics());
  EXPECT_TRUE(metal(Float(1e-4)).is_near_specular() && !metal(Float(1e-4)).is_delta());
  EXPECT_FALSE(metal(Float(1e-3)).is_near_specular());
  EXPECT_TRUE(Bsdf(Lambert{}).lobes().is_diffuse() && !metal(1).is_diffuse());
}

// Bit for bit, even for narrow lobes at grazing angles, where one ulp of the direction changes the results.
TEST(Bsdf, SampleAgreesWithEvalPdfAndEta) {
  const Spectrum half = Spectrum::Constant(Float(0.5)), one = Spectrum::Ones();
  mc::Pcg random(7);
  for (const Float alpha : {Float(1e-4), Float(0.01), Float(1)})
    for (const Bsdf& bsdf :
         {Bsdf(RoughConductor(half, one, TrowbridgeReitzFacets(alpha))),
          Bsdf(RoughConductor(half, one, BlinnPhongFacets(alpha))), Bsdf(RoughPlastic(Float(1.5), alpha, half, one)),
          Bsdf(RoughPlastic<LajollaBase>(Float(1.5), alpha, half, one)), Bsdf(RoughDielectric(Float(1.5), alpha))})
      for (const double angle : {0.0, 60.0, 89.0, 89.9, 89.99, 91.0, 120.0}) {
        const Vec3 wo = support::at_degrees(angle);
        for (int i = 0; i < 200; ++i) {
          const Vec2 u(random.uniform<Float>(), random.uniform<Float>());
          const auto s = bsdf.sample(wo, random.uniform<Float>(), u);
          if (!s) continue;
          EXPECT_EQ(s->pdf, bsdf.pdf(wo, s->wi)) << alpha << ", " << angle << " degrees";
          EXPECT_TRUE((s->f == bsdf.eval(wo, s->wi)).all()) << alpha << ", " << angle << " degrees";
          EXPECT_EQ(s->eta, bsdf.eta(wo, s->wi)) << alpha << ", " << angle << " degrees";
        }
      }
}

// albedo() is at most .01 below the mean sample weight, except for lajolla's paint, which gains energy. It may exceed
// the mean by the light of rough surfaces that hits a second facet or ends below the surface.
TEST(Bsdf, AlbedoApproximatesMeanSampleWeight) {
  const Spectrum half = Spectrum::Constant(Float(0.5)), one = Spectrum::Ones();
  for (const Float alpha : {Float(0.01), Float(0.1), Float(0.3)})
    for (const Bsdf& bsdf :
         {Bsdf(Lambert(half)), Bsdf(FuzzyMetal(half)), Bsdf(FuzzyMetal(half, alpha)),
          Bsdf(Dielectric(Float(1.5), half, half)), Bsdf(SmoothConductor(half, 4 * one)),
          Bsdf(SmoothPlastic(Float(1.5), half, one)), Bsdf(RoughConductor(half, 4 * one, TrowbridgeReitzFacets(alpha))),
          Bsdf(RoughConductor(half, 4 * one, BlinnPhongFacets(alpha))),
          Bsdf(RoughPlastic(Float(1.5), alpha, half, one)),
          Bsdf(RoughPlastic<LajollaBase>(Float(1.5), alpha, half, one)), Bsdf(RoughDielectric(Float(1.5), alpha))})
      for (const double cosine : {0.05, 0.2, 0.5, 0.9, 1.0}) {
        const Vec3 wo = Vec3d(std::sqrt(1 - cosine * cosine), 0, cosine).cast<Float>();
        const double sent = support::albedo(bsdf, cosine, 1 << 14);
        const bool lajolla = std::holds_alternative<RoughPlastic<LajollaBase>>(bsdf);
        EXPECT_GE(double(bsdf.albedo(wo)), sent - (lajolla ? 0.3 : 0.01)) << bsdf.index() << ", " << cosine;
        EXPECT_LE(double(bsdf.albedo(wo)), sent + (lajolla ? 0.3 : 0.2)) << bsdf.index() << ", " << cosine;
      }
}

} // namespace
