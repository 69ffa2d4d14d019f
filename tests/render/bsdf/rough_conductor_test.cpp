#include <render/bsdf/rough_conductor.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/bsdf/roughness_limit.h>
#include <mc/random/pcg.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

#include <array>
#include <complex>

namespace {

using namespace render;

const Spectrum gold(Float(0.143), Float(0.375), Float(1.442)), gold_k(Float(3.983), Float(2.386), Float(1.603));
const Spectrum nothing = Spectrum::Zero(), all = Spectrum::Ones();

template <class Facets> RoughConductor<Facets> metal(double alpha) {
  return RoughConductor<Facets>(gold, gold_k, Facets(Float(alpha)));
}
/// Metal without absorption.
template <class Facets> RoughConductor<Facets> mirror(double alpha) {
  return RoughConductor<Facets>(nothing, all, Facets(Float(alpha)));
}

// Fresnel's amplitudes with a complex index, in double. Random metals range from nearly glass to nearly mirrors.
TEST(FresnelConductor, IsThatOfAComplexIndex) {
  mc::Pcg random(1);
  for (int i = 0; i < 10'000; ++i) {
    const Float cosine = Float(random.uniform<double>()), eta = Float(std::pow(10, 3 * random.uniform<double>() - 1.5)),
                k = Float(std::pow(10, 4 * random.uniform<double>() - 2.5));
    const std::complex<double> n{double(eta), double(k)}, c = double(cosine);
    const std::complex<double> t = std::sqrt(n * n - 1.0 + c * c); // n times the cosine of refraction
    const double s = std::norm((c - t) / (c + t)), p = std::norm((n * n * c - t) / (n * n * c + t));
    const Spectrum f = fresnel_conductor(cosine, Spectrum::Constant(eta), Spectrum::Constant(k));
    EXPECT_NEAR(f[0], (s + p) / 2, 1e-5) << cosine << " " << eta << " " << k;
  }
  for (const Float cosine : {Float(0), Float(0.3), Float(1)}) EXPECT_EQ(fresnel_conductor(cosine, nothing, all)[0], 1);
}

template <class Facets> void expect_laws(const char* name, const std::vector<double>& alphas) {
  for (const double alpha : alphas)
    for (const double angle : {0.0, 60.0, alpha < 1e-3 ? 89 : 89.9, 120.0}) {
      const auto report = mc::check_bsdf<Float>(metal<Facets>(alpha), support::at_degrees(angle),
                                                {.statistics = {.samples = 50'000, .alpha = 1e-5}});
      EXPECT_TRUE(report.passed()) << name << " " << alpha << ", " << angle << " degrees\n" << report.to_string();
    }
}

// Directions on both sides at alpha = 1e-5 each.
TEST(RoughConductor, ObeysTheLaws) { expect_laws<TrowbridgeReitzFacets>("ggx", {1e-4, 1e-3, 0.02, 0.3, 1}); }
TEST(RoughConductor, ObeysTheLawsWithBeckmannFacets) { expect_laws<BeckmannFacets>("beckmann", {1e-4, 0.02, 0.5}); }
TEST(RoughConductor, ObeysTheLawsWithBlinnPhongFacets) {
  expect_laws<BlinnPhongFacets>("phong", {1e-4, 1e-3, 0.02, 0.3, 1});
}

template <class Facets> void expect_limit(const char* name) {
  struct Smooth { // a mirror of gold
    std::optional<BsdfSample> sample(const Vec3& wo, Float, const Vec2&) const {
      const Float c = std::abs(wo.z());
      return BsdfSample{Vec3(-wo.x(), -wo.y(), wo.z()), fresnel_conductor(c, gold, gold_k) / c, 1, true};
    }
    Spectrum eval(const Vec3&, const Vec3&) const { return nothing; }
    Float pdf(const Vec3&, const Vec3&) const { return 0; }
  };
  const auto family = [](Float alpha) { return metal<Facets>(std::max(double(alpha), 1e-4)); };
  for (const double angle : {0.0, 45.0, 70.0, 120.0})
    for (const mc::Check& c : mc::check_roughness_limit<Float>(family, Smooth(), support::at_degrees(angle)))
      EXPECT_EQ(c.verdict, mc::Verdict::pass) << name << " " << angle << " " << c.name << ": " << c.detail;
}

TEST(RoughConductor, TendsToTheMirror) {
  expect_limit<TrowbridgeReitzFacets>("ggx");
  expect_limit<BeckmannFacets>("beckmann");
  expect_limit<BlinnPhongFacets>("phong");
}

// Directional albedos of single scattering, by an independent quadrature, at cosines .9, .5 and .2.
TEST(RoughConductor, LosesMultipleScattering) {
  struct Row {
    double alpha;
    std::array<double, 3> ggx, blinn;
  };
  const std::array<double, 3> cosines = {0.9, 0.5, 0.2};
  for (const Row& row : {Row{0.1, {0.9868, 0.9691, 0.9021}, {1.0000, 0.9990, 0.9502}},
                         Row{0.3, {0.8673, 0.8181, 0.8159}, {0.9789, 0.9236, 0.9391}},
                         Row{0.6, {0.5931, 0.6247, 0.6939}, {0.7350, 0.8498, 0.9410}},
                         Row{1.0, {0.3230, 0.4091, 0.5114}, {0.4118, 0.6531, 0.8620}}})
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(support::albedo(mirror<TrowbridgeReitzFacets>(row.alpha), cosines[i]), row.ggx[i], 0.001)
          << row.alpha;
      EXPECT_NEAR(support::albedo(mirror<BlinnPhongFacets>(row.alpha), cosines[i]), row.blinn[i], 0.001) << row.alpha;
    }
}

TEST(RoughConductor, RefusesNonsense) {
  const TrowbridgeReitzFacets facets{Float(0.1)};
  EXPECT_EQ(support::error_of([&] { RoughConductor(nothing, Spectrum(1, 0, 1), facets); }),
            "rough conductor: eta (0, 0, 0) and k must not both be 0");
  EXPECT_THAT(support::error_of([&] { RoughConductor(gold, Spectrum(1, 2, Float(1e7)), facets); }),
              testing::HasSubstr("must be at most 1"));
  EXPECT_EQ(support::error_of([&] { RoughConductor(gold, -all, facets); }),
            "rough conductor: k (-1, -1, -1) must be finite and >= 0");
  EXPECT_EQ(support::error_of([&] { RoughConductor(-all, all, facets); }),
            "rough conductor: eta (-1, -1, -1) must be finite and >= 0");
  EXPECT_EQ(support::error_of([&] { RoughConductor(gold, all, facets, 2 * all); }),
            "rough conductor: specularReflectance (2, 2, 2) must lie in [0, 1]");
}

} // namespace
