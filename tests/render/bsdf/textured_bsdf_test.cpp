#include <render/bsdf/textured_bsdf.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

namespace {

using namespace render;

const Spectrum bright(Float(0.75), Float(0.5), Float(0.6)),
    dim = Spectrum::Constant(Float(0.25)), grey = Spectrum::Constant(Float(0.4)), full = Spectrum::Ones();
const Texture board = Checkerboard(bright, dim);

// Both directions of reflection and refraction, and both lobes.
void expect_equal(const Bsdf& a, const Bsdf& b, Float tolerance = 0) {
  const Vec3 wo = support::at_degrees(50);
  for (const double angle : {-48.0, 20.0, 160.0, 195.0}) {
    const Vec3 wi = support::at_degrees(angle);
    EXPECT_NEAR((a.eval(wo, wi) - b.eval(wo, wi)).abs().maxCoeff(), 0, tolerance * b.eval(wo, wi).maxCoeff()) << angle;
    EXPECT_NEAR(a.pdf(wo, wi), b.pdf(wo, wi), tolerance * b.pdf(wo, wi)) << angle;
  }
  for (const Float uc : {Float(0), Float(0.9)}) {
    const auto x = a.sample(wo, uc, Vec2(Float(0.2), Float(0.6))), y = b.sample(wo, uc, Vec2(Float(0.2), Float(0.6)));
    ASSERT_TRUE(x && y);
    EXPECT_NEAR((x->f - y->f).abs().maxCoeff(), 0, tolerance * y->f.maxCoeff());
  }
  EXPECT_NEAR(a.albedo(wo), b.albedo(wo), tolerance);
  EXPECT_EQ(a.lobes().roughness, b.lobes().roughness);
}

// At every point, the BSDF with the value of the texture in the place of its parameter.
TEST(TexturedBsdf, IsTheBsdfOfItsColorsEverywhere) {
  const auto rough = [](const Spectrum& diffuse, const Spectrum& specular) {
    return RoughPlastic(Float(1.5), Float(0.2), diffuse, specular, InternalReflections::nonlinear);
  };
  const auto smooth = [](const Spectrum& diffuse, const Spectrum& specular) {
    return SmoothPlastic<LajollaBase>(Float(1.5), diffuse, specular);
  };
  const auto glass = [](const Spectrum& r, const Spectrum& t) { return Dielectric(Float(1.5), r, t); };
  const auto pane = [](const Spectrum& r, const Spectrum& t) { return ThinDielectric(Float(1.5), r, t); };
  const auto ground = [](const Spectrum& r, const Spectrum& t) {
    return RoughDielectric(Float(1.5), Float(0.3), r, t);
  };
  const Spectrum eta(1, Float(0.5), 0), k = Spectrum::Constant(3);
  for (const auto& [uv, color] : {std::pair(Vec2d(0.1, 0.1), bright), {Vec2d(0.6, 0.1), dim}}) {
    const auto expect = [&, uv = uv](Bsdf untextured, BsdfTextures textures, const Bsdf& plain) {
      expect_equal(TexturedBsdf(std::move(untextured), std::move(textures)).at(uv), plain);
    };
    expect(Lambert(grey), {.diffuse_reflectance = board}, Lambert(color));
    expect(rough(grey, full), {.diffuse_reflectance = board}, rough(color, full));
    expect(rough(grey, full), {.specular_reflectance = board}, rough(grey, color));
    expect(smooth(grey, full), {.diffuse_reflectance = board, .specular_reflectance = board}, smooth(color, color));
    expect(glass(full, grey), {.specular_reflectance = board}, glass(color, grey));
    expect(pane(full, grey), {.specular_transmittance = board}, pane(full, color));
    expect(ground(full, grey), {.specular_reflectance = board, .specular_transmittance = board}, ground(color, color));
    expect(SmoothConductor(eta, k), {.specular_reflectance = board}, SmoothConductor(eta, k, color));
    const TrowbridgeReitzFacets facets(Float(0.1));
    expect(RoughConductor(eta, k, facets), {.specular_reflectance = board}, RoughConductor(eta, k, facets, color));
  }
}

TEST(TexturedBsdf, IsTheBsdfOfItsRoughnessEverywhere) {
  const Texture texture = Checkerboard(Spectrum(Float(0.3), Float(0.1), Float(0.2)), Spectrum::Zero());
  const auto expect = [&](const auto& bsdf_of, Float tolerance) {
    const TexturedBsdf textured(bsdf_of(Float(0.5)), {.alpha = RoughnessTexture(texture)}),
        root(bsdf_of(Float(0.5)), {.alpha = RoughnessTexture(texture, true)});
    expect_equal(textured.at({0.1, 0.1}), bsdf_of(Float(0.2)), tolerance);
    expect_equal(root.at({0.1, 0.1}), bsdf_of(mc::sqr(Float(0.2))), tolerance);
    expect_equal(textured.at({0.6, 0.1}), bsdf_of(least_alpha), tolerance);
    expect_equal(textured.untextured(), bsdf_of(least_alpha), tolerance);
  };
  // The tables of a coat are interpolated between roughnesses.
  const auto paint = [](Float alpha) {
    return RoughPlastic<LayeredBase, BeckmannFacets>(Float(1.5), alpha, bright, full, InternalReflections::nonlinear);
  };
  expect([&](Float alpha) { return Bsdf(paint(alpha)); }, Float(0.01));
  expect([&](Float alpha) { return Bsdf(RoughPlastic<LajollaBase>(Float(1.5), alpha, bright, dim)); }, 0);
  expect([&](Float alpha) { return Bsdf(RoughDielectric<BeckmannFacets>(Float(1.5), alpha)); }, 0);
  const Spectrum eta = Spectrum::Zero(), k = Spectrum::Constant(3);
  expect([&](Float alpha) { return Bsdf(RoughConductor(eta, k, TrowbridgeReitzFacets(alpha))); }, 0);
  expect([&](Float alpha) { return Bsdf(RoughConductor(eta, k, BlinnPhongFacets(alpha))); }, 0);
}

// Interpolation between texels rounds above 1, where a reflectance and a roughness may not be.
TEST(TexturedBsdf, StaysInTheRangeOfItsParameters) {
  const Texture white = Bitmap(std::make_shared<const Texels>(3, 3, std::vector<Spectrum>(9, Spectrum::Ones())));
  const TexturedBsdf matt(Lambert(), {.diffuse_reflectance = white}),
      glass(RoughDielectric(Float(1.5), Float(0.2)), {.alpha = RoughnessTexture(white)});
  for (int i = 0; i < 1000; ++i) {
    const Vec2d uv(i * 0.0137, i * 0.0071);
    EXPECT_LE(matt.at(uv).albedo(Vec3::UnitZ()), 1);
    EXPECT_EQ(glass.at(uv).lobes().roughness, 1);
  }
}

TEST(TexturedBsdf, RejectsWrongTextures) {
  const Texture wrong = Checkerboard(Spectrum::Constant(2), Spectrum::Zero());
  const auto error = [](const Bsdf& bsdf, const BsdfTextures& textures) {
    return support::error_of([&] { TexturedBsdf(bsdf, textures); });
  };
  const SmoothPlastic paint(Float(1.5), dim, dim);
  EXPECT_EQ(error(paint, {.diffuse_reflectance = wrong}), "diffuse reflectance: color0 (2, 2, 2) must lie in [0, 1]");
  EXPECT_EQ(error(paint, {.specular_reflectance = wrong}), "specular reflectance: color0 (2, 2, 2) must lie in [0, 1]");
  EXPECT_EQ(error(Dielectric(), {.specular_transmittance = wrong}),
            "specular transmittance: color0 (2, 2, 2) must lie in [0, 1]");
  EXPECT_EQ(support::error_of([&] { RoughnessTexture{wrong}; }), "alpha: color0 (2, 2, 2) must lie in [0, 1]");
  EXPECT_EQ(error(paint, {.alpha = RoughnessTexture(board)}), "textured BSDF: this BSDF has no alpha");
  EXPECT_EQ(error(paint, {.specular_transmittance = board}), "textured BSDF: this BSDF has no specular transmittance");
}

TEST(TexturedBsdf, IsOneOfItsKind) {
  const TexturedBsdf matt(Lambert(), {.diffuse_reflectance = board});
  EXPECT_TRUE(matt.untextured().lobes().is_diffuse() && matt.at({0.1, 0.1}).lobes().is_diffuse());
  const TexturedBsdf lacquer(SmoothPlastic(Float(1.5), dim, bright), {.diffuse_reflectance = board});
  EXPECT_TRUE(lacquer.untextured().lobes().has_delta && lacquer.at({0.1, 0.1}).lobes().has_delta);
}

} // namespace
