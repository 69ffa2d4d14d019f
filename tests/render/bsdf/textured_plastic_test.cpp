#include <render/bsdf/bsdf.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

namespace {

using namespace render;

const Spectrum bright(Float(0.75), Float(0.5), Float(0.6)), dim = Spectrum::Constant(Float(0.25));

template <class Paint> void expect_paint_of_the_colors(const Paint& untextured, const auto& paint_of) {
  const Texture board = Checkerboard(bright, dim);
  const TexturedPlastic<Paint> base(untextured, board, {}), coat(untextured, {}, board), both(untextured, board, board);
  const Vec3 wo = support::at_degrees(50), wi = support::at_degrees(-48);
  for (const auto& [uv, color] : {std::pair(Vec2d(0.1, 0.1), bright), {Vec2d(0.6, 0.1), dim}}) {
    const auto expect = [&, uv = uv](const TexturedPlastic<Paint>& textured, const Paint& plain) {
      const Paint there = textured.at(uv);
      EXPECT_TRUE((there.eval(wo, wi) == plain.eval(wo, wi)).all());
      EXPECT_EQ(there.pdf(wo, wi), plain.pdf(wo, wi));
      for (const Float uc : {Float(0), Float(0.9)}) {
        const Vec2 u(Float(0.2), Float(0.6));
        EXPECT_TRUE((there.sample(wo, uc, u)->f == plain.sample(wo, uc, u)->f).all());
        EXPECT_EQ(there.albedo(wo), plain.albedo(wo));
      }
    };
    expect(base, paint_of(color, untextured.specular()));
    expect(coat, paint_of(untextured.diffuse(), color));
    expect(both, paint_of(color, color));
  }
}

TEST(TexturedPlastic, IsThePaintOfItsColorsEverywhere) {
  const auto rough = [](const Spectrum& diffuse, const Spectrum& specular) {
    return RoughPlastic(Float(1.5), Float(0.2), diffuse, specular);
  };
  const auto smooth = [](const Spectrum& diffuse, const Spectrum& specular) {
    return SmoothPlastic<LajollaBase>(Float(1.5), diffuse, specular);
  };
  const Spectrum grey = Spectrum::Constant(Float(0.4)), one = Spectrum::Ones();
  expect_paint_of_the_colors(rough(grey, one), rough);
  expect_paint_of_the_colors(smooth(grey, one), smooth);
}

TEST(TexturedPlastic, ReflectsNoMoreThanItGets) {
  const SmoothPlastic paint(Float(1.5), dim, dim);
  using Textured = TexturedPlastic<SmoothPlastic<>>;
  const Texture wrong = Checkerboard(Spectrum::Constant(2), Spectrum::Zero());
  EXPECT_THAT(support::error_of([&] { Textured(paint, wrong, {}); }),
              testing::HasSubstr("plastic: diffuseReflectance: color0 (2, 2, 2) must lie in [0, 1]"));
  EXPECT_THAT(support::error_of([&] { Textured(paint, {}, wrong); }),
              testing::HasSubstr("plastic: specularReflectance: color0 (2, 2, 2) must lie in [0, 1]"));
}

TEST(TexturedBsdf, IsOneOfItsKind) {
  const TexturedBsdf matt = TexturedLambert(Checkerboard(bright, dim));
  EXPECT_TRUE(matt.untextured().lobes().is_diffuse() && matt.at({0.1, 0.1}).lobes().is_diffuse());
  const TexturedBsdf lacquer =
      TexturedPlastic(SmoothPlastic(Float(1.5), dim, bright), Texture(Checkerboard(bright, dim)), {});
  EXPECT_TRUE(lacquer.untextured().lobes().has_delta && lacquer.at({0.1, 0.1}).lobes().has_delta);
}

} // namespace
