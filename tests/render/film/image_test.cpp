#include <render/film/image.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Image, RowMajorBlackAndWithoutVariance) {
  Image image(3, 2);
  ASSERT_EQ(image.pixels.size(), 6u);
  EXPECT_TRUE(image.variance.empty());
  for (const Spectrum& p : image.pixels) EXPECT_TRUE(is_black(p));
  image.at(2, 1) = Spectrum::Constant(4);
  EXPECT_EQ(image.index(2, 1), 5u);
  EXPECT_TRUE((image.pixels.back() == 4).all());
}

} // namespace
