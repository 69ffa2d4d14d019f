#include <picture/crop.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using render::Float;
using testing::ElementsAre;
using testing::HasSubstr;

render::Image numbered_picture() {
  render::Image image(4, 3);
  image.variance = image.pixels;
  for (int i = 0; i < 12; ++i) {
    image.pixels[static_cast<std::size_t>(i)].setConstant(Float(i));
    image.variance[static_cast<std::size_t>(i)].setConstant(Float(10 * i));
    image.layers["Z"].push_back(float(100 * i));
  }
  image.metadata = {{"carlo.crop", "7,8,4,3"}};
  return image;
}

TEST(CropPicture, KeepsPixelsVarianceAndLayersOfThePart) {
  render::Image image = numbered_picture();
  carlo::crop_picture(image, {2, 1, 2, 2}, "a.exr");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  ASSERT_EQ(image.pixels.size(), 4u);
  ASSERT_EQ(image.variance.size(), 4u);
  EXPECT_EQ(image.at(0, 0)[0], Float(6));
  EXPECT_EQ(image.at(1, 1)[2], Float(11));
  EXPECT_EQ(image.variance[2][1], Float(100));
  EXPECT_THAT(image.layers.at("Z"), ElementsAre(600, 700, 1000, 1100));
  EXPECT_EQ(image.metadata.at("carlo.crop"), "9,9,2,2");
}

TEST(CropPicture, ForeignCropInMetadata_IsRemoved) {
  for (const std::string text : {"", "x", "0,0,9,9", "1,2,3"}) {
    render::Image image = numbered_picture();
    image.metadata["carlo.crop"] = text;
    carlo::crop_picture(image, {0, 0, 1, 1}, "a.exr");
    EXPECT_FALSE(image.metadata.contains("carlo.crop")) << text;
  }
}

TEST(CropPicture, RefusesPartsOutside) {
  for (const render::Crop& part : {render::Crop{-1, 0, 1, 1},
                                   {0, 0, 0, 1},
                                   {3, 0, 2, 1},
                                   {0, 3, 1, 1},
                                   {1'000'000'000, 0, 1'000'000'000, 1},
                                   {0, 0, 5, 3},
                                   {0, 0, 1, -2}}) {
    render::Image image = numbered_picture();
    EXPECT_THAT(support::error_of([&] { carlo::crop_picture(image, part, "a.exr"); }),
                HasSubstr("must lie within the 4x3 pixels of 'a.exr'"));
  }
}

} // namespace
