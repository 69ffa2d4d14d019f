#include <render/texture/mask.h>

#include "support/files.h"

namespace {

using render::Float, render::Mask, render::Spectrum, render::Texture, render::Vec2d;

TEST(Mask, IsAsOpaqueAsItsTextureIsBright) {
  EXPECT_FALSE(Mask(Float(0.3)).varies());
  EXPECT_EQ(Mask(Float(0.3)).opacity(Vec2d(0.2, 0.7)), Float(0.3));
  const Mask board(Texture(render::Checkerboard(Spectrum(1, Float(0.5), 0), Spectrum::Zero())));
  EXPECT_TRUE(board.varies());
  EXPECT_EQ(board.opacity({0.1, 0.1}), Float(0.5));
  EXPECT_EQ(board.opacity({0.6, 0.1}), 0);
  // An opacity of 1 is exact, so no random decision is made.
  EXPECT_EQ(Mask(Texture(render::Checkerboard(Spectrum::Ones(), Spectrum::Ones()))).opacity({0.1, 0.1}), 1);
}

TEST(Mask, BadInput) {
  for (const Float bad : {Float(-0.1), Float(1.1), std::numeric_limits<Float>::quiet_NaN()})
    EXPECT_THAT(support::error_of([&] { Mask{bad}; }), testing::StartsWith(fmt::format("mask: opacity {}", bad)));
  const Spectrum half = Spectrum::Constant(Float(0.5));
  EXPECT_EQ(support::error_of([&] { Mask{Texture(render::Checkerboard(half, Spectrum(0, 2, 0)))}; }),
            "mask: opacity: color1 (0, 2, 0) must lie in [0, 1]");
  EXPECT_EQ(support::error_of([&] { Mask{Texture(render::Checkerboard(half, Spectrum(0, 0, -1)))}; }),
            "mask: opacity: color1 (0, 0, -1) must lie in [0, 1]");
}

} // namespace
