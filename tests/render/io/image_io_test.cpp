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
    for (auto& p : image.pixels)
      p = render::Spectrum(random.uniform<float>() * 100, random.uniform<float>(), -random.uniform<float>());
    if (with_variance) image.variance.assign(image.pixels.size(), render::Spectrum(1e-8f, 2, 3e10f));
    image.metadata = {{"carlo.command", "carlo render \"a b\" --spp 4"}, {"carlo.seed", "7"}};
    return image;
  }
  static void expect_equal(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(static_cast<float>(a.pixels[i][c]), static_cast<float>(b.pixels[i][c])) << i;
  }
};

TEST_F(ImageIo, ExrKeepsRadianceVarianceAndMetadata) {
  const Image image = picture(true);
  render::write_image(path("a.exr"), image);
  const Image back = render::read_image(path("a.exr"));
  expect_equal(image, back);
  ASSERT_EQ(back.variance.size(), image.variance.size());
  for (std::size_t i = 0; i < image.variance.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(static_cast<float>(back.variance[i][c]), static_cast<float>(image.variance[i][c]));
  EXPECT_EQ(back.metadata.at("carlo.command"), "carlo render \"a b\" --spp 4");
  EXPECT_EQ(back.metadata.at("carlo.seed"), "7");

  render::write_image(path("b.exr"), picture(false));
  EXPECT_TRUE(render::read_image(path("b.exr")).variance.empty());
}

// A grey image as other programs write it: 2x1 pixels, the one channel Y.
TEST_F(ImageIo, ExrOfLuminanceAloneIsGrey) {
  const auto number = [](auto x) { return std::string(reinterpret_cast<const char*>(&x), sizeof x); };
  const auto text = [](const char* s) { return std::string(s) + '\0'; };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    return text(name) + text(type) + number(static_cast<std::int32_t>(value.size())) + value;
  };
  const std::string box = number(0) + number(0) + number(1) + number(0);
  std::string file = number(20000630) + number(2);
  file += attribute("channels", "chlist", text("Y") + number(2) + number(0) + number(1) + number(1) + '\0');
  file += attribute("compression", "compression", std::string(1, '\0'));
  file += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box);
  file +=
      attribute("lineOrder", "lineOrder", std::string(1, '\0')) + attribute("pixelAspectRatio", "float", number(1.0f));
  file += attribute("screenWindowCenter", "v2f", number(0.0f) + number(0.0f)) +
          attribute("screenWindowWidth", "float", number(1.0f)) + '\0';
  file += number(static_cast<std::uint64_t>(file.size() + 8)) + number(0) + number(8) + number(0.25f) + number(3.0f);
  const Image image = render::read_image(write("grey.exr", file));
  ASSERT_EQ(image.width, 2);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(image.at(0, 0)[c], render::Float(0.25)) << c;
    EXPECT_EQ(image.at(1, 0)[c], render::Float(3)) << c;
  }
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
  EXPECT_NE(bytes.find(std::string("tEXtcarlo.seed\0"
                                   "7",
                                   16)),
            std::string::npos);
}

TEST_F(ImageIo, RefusesWithOneLine) {
  const Image image = picture(false);
  EXPECT_THAT(support::error_of([&] { render::write_image(path("a.jpg"), image); }),
              testing::HasSubstr("unknown image format '.jpg'; use .exr, .pfm or .png"));
  EXPECT_THAT(support::error_of([&] { render::write_image(path("none/a.exr"), image); }),
              testing::HasSubstr("does not exist; create it first"));
  EXPECT_THAT(support::error_of([&] { render::read_image(path("none.exr")); }), testing::HasSubstr("no such file"));
  write("broken.exr", "not an image");
  EXPECT_THAT(support::error_of([&] { render::read_image(path("broken.exr")); }),
              testing::HasSubstr("cannot read EXR"));
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
