#include <render/io/image/image_io.h>
#include <render/io/image/srgb.h>

#include <mc/core/file.h>
#include <mc/random/pcg.h>

#include "support/files.h"

#include <array>

namespace {

using render::Image;

// The checksum of a PNG chunk over its type and data, in the byte order of the file.
std::string png_crc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  std::string text;
  for (int i = 0; i < 4; ++i) text += static_cast<char>(~crc >> (24 - 8 * i) & 0xff);
  return text;
}

struct ImageIo : support::ScratchTest {
  static Image picture(bool with_variance) {
    Image image(7, 5);
    mc::Pcg random(1);
    for (auto& p : image.pixels)
      p = render::Spectrum(random.uniform<float>() * 100, random.uniform<float>(), -random.uniform<float>());
    if (with_variance) {
      image.variance.assign(image.pixels.size(), render::Spectrum(1e-8f, 2, 3e10f));
      image.estimates = 4;
    }
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
  EXPECT_EQ(back.estimates, 4u);

  render::write_image(path("b.exr"), picture(false));
  EXPECT_TRUE(render::read_image(path("b.exr")).variance.empty());
}

TEST_F(ImageIo, ExrKeepsLayers) {
  Image image = picture(true);
  mc::Pcg random(3);
  for (const char* name : {"Z", "N.X", "albedo.B", "id"})
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.layers[name].push_back(random.uniform<float>());
  image.layers["Z"][3] = mc::infinity<float>;
  render::write_image(path("layers.exr"), image);
  const Image back = render::read_image(path("layers.exr"));
  expect_equal(image, back);
  EXPECT_EQ(back.variance.size(), image.variance.size());
  EXPECT_EQ(back.layers, image.layers);
}

std::string number(auto x) { return std::string(reinterpret_cast<const char*>(&x), sizeof x); }

// An EXR as other programs write it: 2x1 pixels 0.25 and 3, equal in all channels. Optionally with chromaticities and
// an envmap attribute.
std::string exr_of(const std::vector<std::string>& channels, const std::vector<float>& chromaticities = {},
                   const std::string& envmap = {}) {
  const auto text = [](const std::string& s) { return s + '\0'; };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    return text(name) + text(type) + number(static_cast<std::int32_t>(value.size())) + value;
  };
  const std::string box = number(0) + number(0) + number(1) + number(0);
  std::string file = number(20000630) + number(2), list, colours, row;
  for (const std::string& c : channels) {
    list += text(c) + number(2) + number(0) + number(1) + number(1);
    row += number(0.25f) + number(3.0f);
  }
  for (const float x : chromaticities) colours += number(x);
  file += attribute("channels", "chlist", list + '\0');
  if (!colours.empty()) file += attribute("chromaticities", "chromaticities", colours);
  file += attribute("compression", "compression", std::string(1, '\0'));
  file += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box);
  if (!envmap.empty()) file += attribute("envmap", "envmap", envmap);
  file +=
      attribute("lineOrder", "lineOrder", std::string(1, '\0')) + attribute("pixelAspectRatio", "float", number(1.0f));
  file += attribute("screenWindowCenter", "v2f", number(0.0f) + number(0.0f)) +
          attribute("screenWindowWidth", "float", number(1.0f)) + '\0';
  return file + number(static_cast<std::uint64_t>(file.size() + 8)) + number(0) +
         number(static_cast<std::int32_t>(row.size())) + row;
}

TEST_F(ImageIo, ExrOfLuminanceAloneIsGrey) {
  for (const std::vector<std::string>& channels : {std::vector<std::string>{"Y"}, {"B", "G", "R"}}) {
    const Image image = render::read_image(write("grey.exr", exr_of(channels)));
    ASSERT_EQ(image.width, 2);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(image.at(0, 0)[c], render::Float(0.25)) << c;
      EXPECT_EQ(image.at(1, 0)[c], render::Float(3)) << c;
    }
  }
}

// Without the check, the values would be read as other colours.
TEST_F(ImageIo, ExrOfOtherColoursIsRefused) {
  const auto said = [&](const std::string& bytes) {
    return support::error_of([&] { render::read_image(write("a.exr", bytes)); });
  };
  EXPECT_THAT(said(exr_of({"BY", "RY", "Y"})),
              testing::HasSubstr("a.exr: EXR holds luminance and chroma (a channel RY)"));
  const std::vector<float> ours = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  EXPECT_EQ(said(exr_of({"B", "G", "R"}, ours)), "");
  EXPECT_EQ(said(exr_of({"B", "G", "R"}, {}, std::string(1, '\0'))), "") << "latitude and longitude";
  EXPECT_THAT(said(exr_of({"B", "G", "R"}, {}, "\1")),
              testing::HasSubstr("a.exr: EXR says in its envmap that it holds the sides of a cube; convert it"));
  const char* names[] = {"red", "green", "blue", "white"};
  for (std::size_t i = 0; i < 8; ++i)
    for (const float off : {0.0002f, -0.005f, std::numeric_limits<float>::quiet_NaN()}) {
      std::vector<float> other = ours;
      other[i] += off;
      const std::string text = said(exr_of({"B", "G", "R"}, other));
      if (off > 0) EXPECT_EQ(text, "") << i;
      else EXPECT_THAT(text, testing::HasSubstr(fmt::format("in its chromaticities that {} is (", names[i / 2])));
    }
}

// Radiance is the value times the size of the scale; the sign of the scale is the byte order.
TEST_F(ImageIo, PfmHasAScale) {
  const std::string little = number(1.0f) + number(0.5f) + number(3.0f), big(little.rbegin(), little.rend());
  const Image a = render::read_image(write("a.pfm", "PF\n1 1\n-2.5\n" + little)),
              b = render::read_image(write("b.pfm", "PF\n1 1\n10\n" + big));
  EXPECT_TRUE((a.at(0, 0) == render::Spectrum(2.5f, 1.25f, 7.5f)).all());
  EXPECT_TRUE((b.at(0, 0) == render::Spectrum(30, 5, 10)).all());
  for (const char* scale : {"0", "1e999", "nan"})
    EXPECT_NE(
        support::error_of([&] { render::read_image(write("c.pfm", fmt::format("PF\n1 1\n{}\n{}", scale, big))); }), "");
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
  image.at(0, 0) = render::Spectrum(0.25f, 0.0015f, 7);
  image.metadata = {{"carlo.command", "carlo render \"\u00fc.xml\""}, {"carlo.seed", "7"}};
  render::write_image(path("a.png"), image, {.exposure = 1});
  EXPECT_TRUE(mc::read_file(path("a.png")).starts_with("\x89PNG\r\n"));
  const Image back = render::read_image(path("a.png"));
  EXPECT_EQ(back.metadata, image.metadata);
  EXPECT_NEAR(back.at(0, 0)[0], 0.5, 0.005); // doubled, and rounded to 8 bits of the encoded value
  EXPECT_NEAR(back.at(0, 0)[1], 0.003, 0.0002);
  EXPECT_EQ(back.at(0, 0)[2], 1);
  EXPECT_TRUE((back.at(1, 0) == 0).all());
}

// All 256 codes of a grey ramp survive writing and reading.
TEST_F(ImageIo, PngKeepsEveryCode) {
  Image image(256, 1);
  for (int i = 0; i < 256; ++i) image.at(i, 0).setConstant(render::Float(render::srgb_to_linear(i / 255.0)));
  render::write_image(path("ramp.png"), image);
  expect_equal(image, render::read_image(path("ramp.png")));
}

// The sRGB chunk has priority over gAMA; sRGB is the default.
TEST_F(ImageIo, PngHasAGamma) {
  Image image(256, 1);
  for (int i = 0; i < 256; ++i) image.at(i, 0).setConstant(render::Float(render::srgb_to_linear(i / 255.0)));
  render::write_image(path("srgb.png"), image);
  const std::string srgb = mc::read_file(path("srgb.png"));
  const std::size_t at = srgb.find("sRGB") - 4, length = 4 + 4 + 1 + 4;
  const std::string gamma("gAMA\0\0\xc3\x50", 8), chunk = std::string("\0\0\0\4", 4) + gamma + png_crc(gamma); // 0.5
  std::string both = srgb, alone = srgb, neither = srgb;
  expect_equal(image, render::read_image(write("both.png", both.insert(at, chunk))));
  expect_equal(image, render::read_image(write("neither.png", neither.erase(at, length))));
  const Image square = render::read_image(write("alone.png", alone.replace(at, length, chunk)));
  for (int i = 0; i < 256; ++i) EXPECT_NEAR(square.at(i, 0)[1], i * i / 65025.0, 1e-6) << i;
}

// A file truncated at any byte is read completely (if no pixels are missing) or rejected with a one-line error.
TEST_F(ImageIo, TruncatedAtAnyByte) {
  for (const std::string extension : {".exr", ".pfm", ".png"}) {
    const Image image = picture(extension == ".exr");
    const std::string file = path("whole" + extension);
    render::write_image(file, image);
    const Image whole = render::read_image(file);
    const std::string bytes = mc::read_file(file);
    int refused = 0;
    for (std::size_t n = 0; n < bytes.size(); n += n + 400 < bytes.size() ? 7 : 1) {
      const std::string part = write("part" + extension, bytes.substr(0, n));
      const std::string said = support::error_of([&] { expect_equal(whole, render::read_image(part)); });
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      if (said.empty()) continue;
      ++refused;
      EXPECT_THAT(said, testing::HasSubstr("part" + extension)) << n;
    }
    EXPECT_GT(refused, 50) << extension;
  }
}

TEST_F(ImageIo, SizesThatTheBytesCannotHold) {
  // PFM: a product that overflows 64 bits.
  write("huge.pfm", "PF\n2147483647 2147483647\n-1.0\n12345678");
  EXPECT_THAT(support::error_of([&] { render::read_image(path("huge.pfm")); }), testing::HasSubstr("ends early"));
  // PNG: the width is in bytes 16 to 19 of the header; the checksum is corrected.
  render::write_image(path("small.png"), picture(false));
  std::string png = mc::read_file(path("small.png"));
  png.replace(16, 8, std::string("\x00\x0f\x42\x40\x00\x0f\x42\x40", 8));
  png.replace(29, 4, png_crc(std::string_view(png).substr(12, 17)));
  write("huge.png", png);
  EXPECT_THAT(support::error_of([&] { render::read_image(path("huge.png")); }),
              testing::HasSubstr("PNG says 1000000x1000000, which its"));
  // EXR: the far corner of the data window.
  render::write_image(path("small.exr"), picture(false));
  std::string exr = mc::read_file(path("small.exr"));
  const std::size_t window = exr.find("dataWindow") + 11 + 6 + 4;
  exr.replace(window + 8, 8, std::string("\xff\xff\xff\x3f\xff\xff\xff\x3f", 8));
  write("huge.exr", exr);
  EXPECT_NE(support::error_of([&] { render::read_image(path("huge.exr")); }), "");
  // No columns, no rows, or neither: the far corner lies one before the near corner (0, 0).
  for (const auto& [at, size] : {std::pair<std::size_t, std::size_t>{8, 4}, {12, 4}, {8, 8}}) {
    write("none.exr", mc::read_file(path("small.exr")).replace(window + at, size, std::string(size, '\xff')));
    EXPECT_THAT(support::error_of([&] { render::read_image(path("none.exr")); }),
                testing::AllOf(testing::HasSubstr("none.exr"), testing::HasSubstr("EXR")))
        << at << ", " << size;
  }
  exr = mc::read_file(path("small.exr")).replace(window + 8, 4, std::string("\x7f\x96\x98\0", 4));
  write("large.exr", exr);
  EXPECT_THAT(support::error_of([&] { render::read_image(path("large.exr")); }),
              testing::ContainsRegex("EXR says 10000000x[0-9]+ in 3 channels, which its"));
}

TEST_F(ImageIo, RefusesWithOneLine) {
  const Image image = picture(false);
  EXPECT_THAT(support::error_of([&] { render::write_image(path("a.jpg"), image); }),
              testing::HasSubstr("unknown image format '.jpg'; use .exr, .pfm or .png"));
  EXPECT_THAT(support::error_of([&] { render::read_image(path("a.gif")); }),
              testing::HasSubstr(
                  "unknown image format '.gif'; use .exr, .pfm, .hdr, .png, .jpg, .jpeg, .bmp, .tga, .ppm or .pgm"));
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
  Image wrong; // no pixels: the format cannot represent it
  wrong.metadata["type"] = "x";
  EXPECT_NE(support::error_of([&] { render::write_image(path("a.exr"), wrong); }), "");
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  expect_equal(image, render::read_image(path("a.pfm")));
}

// Red on the left, blue on the right, within the loss of the compression: no code is off by more than 2.
TEST_F(ImageIo, JpegInItsForms) {
  const std::string jpg = MC_SOURCE_DIR "/tests/fuzz/corpus/jpg/";
  for (const char* name : {"rgb.jpg", "progressive.jpg", "trailing.jpg"}) {
    const Image image = render::read_image(jpg + name);
    ASSERT_EQ(image.width, 32) << name;
    ASSERT_EQ(image.height, 8) << name;
    for (const int x : {0, 15, 16, 31})
      for (int c = 0; c < 3; ++c) {
        const double code = (x < 16 ? std::array{200, 40, 30} : std::array{20, 60, 180})[std::size_t(c)];
        const double value = double(image.pixels[5 * 32 + std::size_t(x)][c]);
        EXPECT_GE(value, render::srgb_to_linear((code - 2) / 255)) << name << " " << x << " " << c;
        EXPECT_LE(value, render::srgb_to_linear((code + 2) / 255)) << name << " " << x << " " << c;
      }
  }
  const std::string whole = mc::read_file(jpg + "rgb.jpg");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string file = write("short.jpg", whole.substr(0, n));
    EXPECT_THAT(support::error_of([&] { render::read_image(file); }), testing::HasSubstr("short.jpg")) << n;
  }
  EXPECT_THAT(support::error_of([&] { render::read_image(jpg + "broken-short.jpg"); }),
              testing::HasSubstr("broken-short.jpg: broken JPEG: Premature end of JPEG file"));
  EXPECT_THAT(support::error_of([&] { render::read_image(jpg + "broken-huge.jpg"); }),
              testing::HasSubstr("JPEG says 60000x60000, which its 295 bytes cannot hold"));
}

} // namespace
