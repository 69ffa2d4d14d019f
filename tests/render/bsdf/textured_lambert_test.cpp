#include <render/bsdf/textured_lambert.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(TexturedLambert, IsALambertEverywhere) {
  const TexturedLambert board(Checkerboard(Spectrum::Constant(Float(0.75)), Spectrum::Constant(Float(0.25))));
  EXPECT_EQ(board.at({0.1, 0.1}).albedo()[0], Float(0.75));
  EXPECT_EQ(board.at({0.6, 0.1}).albedo()[2], Float(0.25));
}

TEST(TexturedLambert, ReflectsNoMoreThanItGets) {
  EXPECT_THROW(TexturedLambert(Checkerboard(Spectrum::Constant(2), Spectrum::Zero())), mc::Error);
  EXPECT_THROW(TexturedLambert(Checkerboard(Spectrum::Constant(-1), Spectrum::Zero())), mc::Error);
  // A white texture: interpolation may round above 1, but the reflectance stays at most 1.
  const TexturedLambert white(Bitmap(std::make_shared<const Texels>(3, 3, std::vector<Spectrum>(9, Spectrum::Ones()))));
  for (int i = 0; i < 1000; ++i) EXPECT_NO_THROW(white.at({i * 0.0137, i * 0.0071}));
}

} // namespace
