#include <render/io/image_io.h>

#include <mc/core/file.h>
#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using render::Image;

struct ImageIo : support::ScratchTest {
  static Image picture(bool with_variance) {
    Image image(7, 5);
    mc::Pcg random(1);
    for (auto& p : image.pixels) p = render::Spectrum(random.uniform<float>() * 100, random.uniform<float>(), -random.uniform<float>());
    if (with_variance) image.variance.assign(image.pixels.size(), render::Spectrum(1e-8f, 2, 3e10f));
    image.metadata = {{"carlo.command", "carlo render \"a b\" --spp 4"}, {"carlo.seed", "7"}};
    return image;
  }
  static void expect_equal(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(static_cast<float>(a.pixels[i][c]), static_cast<float>(b.pixels[i][c])) << i;
  }
};

TEST_F(ImageIo, ExrKeepsRadianceVarianceAndMetadata) {
  const Image image = picture(true);
  render::write_image(path("a.exr"), image);
  const Image back = render::read_image(path("a.exr"));
  expect_equal(image, back);
  ASSERT_EQ(back.variance.size(), image.variance.size());
  for (std::size_t i = 0; i < image.variance.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(static_cast<float>(back.variance[i][c]), static_cast<float>(image.variance[i][c]));
  EXPECT_EQ(back.metadata.at("carlo.command"), "carlo render \"a b\" --spp 4");
  EXPECT_EQ(back.metadata.at("carlo.seed"), "7");

  render::write_image(path("b.exr"), picture(false));
  EXPECT_TRUE(render::read_image(path("b.exr")).variance.empty());
}

TEST_F(ImageIo, PfmKeepsRadianceBottomRowFirst) {
  const Image image = picture(false);
  render::write_image(path("a.pfm"), image);
  expect_equal(image, render::read_image(path("a.pfm")));
  const std::string bytes = mc::read_file(path("a.pfm"));
  EXPECT_TRUE(bytes.starts_with("PF\n7 5\n-1.0\n"));
  float first;
  std::memcpy(&first, bytes.data() + 12, 4);
  EXPECT_EQ(first, static_cast<float>(image.at(0, 4)[0]));
}

TEST_F(ImageIo, PngIsSrgbWithExposureAndText) {
  Image image(2, 1);
  image.at(0, 0).setConstant(0.25f);
  image.metadata = {{"carlo.seed", "7"}};
  render::write_image(path("a.png"), image, 1);
  const std::string bytes = mc::read_file(path("a.png"));
  EXPECT_TRUE(bytes.starts_with("\x89PNG\r\n"));
  EXPECT_NE(bytes.find(std::string("tEXtcarlo.seed\0" "7", 16)), std::string::npos);
}

TEST_F(ImageIo, RefusesWithOneLine) {
  const Image image = picture(false);
  EXPECT_THAT(support::error_of([&] { render::write_image(path("a.jpg"), image); }), testing::HasSubstr("unknown image format '.jpg'; use .exr, .pfm or .png"));
  EXPECT_THAT(support::error_of([&] { render::write_image(path("none/a.exr"), image); }), testing::HasSubstr("does not exist; create it first"));
  EXPECT_THAT(support::error_of([&] { render::read_image(path("none.exr")); }), testing::HasSubstr("no such file"));
  write("broken.exr", "not an image");
  EXPECT_THAT(support::error_of([&] { render::read_image(path("broken.exr")); }), testing::HasSubstr("cannot read EXR"));
  write("broken.pfm", "P6\n1 1\n255\n");
  EXPECT_THAT(support::error_of([&] { render::read_image(path("broken.pfm")); }), testing::HasSubstr("not a PFM file"));
  write("short.pfm", "PF\n4 4\n-1.0\nabc");
  EXPECT_THAT(support::error_of([&] { render::read_image(path("short.pfm")); }), testing::HasSubstr("ends early"));
}

TEST_F(ImageIo, AFailedWriteLeavesTheOldImage) {
  const Image image = picture(false);
  render::write_image(path("a.pfm"), image);
  Image wrong; // no pixels: the format cannot hold it
  wrong.metadata["type"] = "x";
  EXPECT_NE(support::error_of([&] { render::write_image(path("a.exr"), wrong); }), "");
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  expect_equal(image, render::read_image(path("a.pfm")));
}

} // namespace
