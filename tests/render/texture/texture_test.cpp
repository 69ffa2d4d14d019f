#include <render/texture/texture.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Texture, IsWhatItHolds) {
  const Spectrum one = Spectrum::Ones(), two = 2 * one;
  const Texture board = Checkerboard(one, two);
  const Texture picture = Bitmap(std::make_shared<const Texels>(1, 1, std::vector<Spectrum>{two}));
  EXPECT_EQ(board.eval({0.7, 0.2})[0], 2);
  EXPECT_EQ(picture.eval({0.7, 0.2})[0], 2);
  EXPECT_EQ(board.smallest()[0], 1);
  EXPECT_EQ(picture.largest()[0], 2);
}

} // namespace
