#include <render/texture/texture.h>

#include "support/files.h"

namespace {

using namespace render;

TEST(Texture, IsWhatItHolds) {
  const Spectrum one = Spectrum::Ones(), two = 2 * one;
  const Texture board = Checkerboard(one, two);
  const Texture picture = Bitmap(std::make_shared<const Texels>(1, 1, std::vector<Spectrum>{two}));
  EXPECT_EQ(board.eval({0.7, 0.2})[0], 2);
  EXPECT_EQ(picture.eval({0.7, 0.2})[0], 2);
  EXPECT_NO_THROW(Texture(Checkerboard(one, 0 * one)).require_reflectance("it"));
  EXPECT_EQ(support::error_of([&] { board.require_reflectance("it"); }), "it: color1 (2, 2, 2) must lie in [0, 1]");
  EXPECT_THAT(support::error_of([&] { picture.require_reflectance("it"); }),
              testing::StartsWith("it: texel (0, 0) = (2"));
}

} // namespace
