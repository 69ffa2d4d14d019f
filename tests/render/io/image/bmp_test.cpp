// BMP images, written here as other programs write them.

#include <render/io/image/image_io.h>

#include "support/files.h"

namespace {

using testing::HasSubstr;

std::string little(std::uint32_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
  return bytes;
}

// Two headers and the pixels. Masks follow the headers for compression 3.
std::string bmp(int width, int height, std::uint32_t bits, const std::string& pixels, std::uint32_t compression = 0,
                const std::string& masks = {}) {
  const auto start = static_cast<std::uint32_t>(54 + masks.size());
  return "BM" + little(start + static_cast<std::uint32_t>(pixels.size()), 4) + little(0, 4) + little(start, 4) +
         little(40, 4) + little(static_cast<std::uint32_t>(width), 4) + little(static_cast<std::uint32_t>(height), 4) +
         little(1, 2) + little(bits, 2) + little(compression, 4) + std::string(20, '\0') + masks + pixels;
}
// A 3x2 image whose codes (red, green, blue) are (y, x, 7), the bottom row first and padded.
std::string pixels_of(std::size_t pixel_bytes, bool is_top_down) {
  std::string all;
  for (const int row : {0, 1}) {
    std::string line;
    for (int x = 0; x < 3; ++x) {
      line += {7, static_cast<char>(x), static_cast<char>(is_top_down ? row : 1 - row)};
      line.append(pixel_bytes - 3, '\x55');
    }
    line.resize((line.size() + 3) / 4 * 4);
    all += line;
  }
  return all;
}

struct Bmp : support::ScratchTest {
  render::Image read(const std::string& bytes) const { return render::read_image(write("a.bmp", bytes), {{1.0}}); }
  std::string refusal(const std::string& bytes) const {
    const std::string said = support::error_of([&] { read(bytes); });
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
  }
};

TEST_F(Bmp, RowsBeginBelowAndBlueIsFirst) {
  const std::string masks = little(0xff0000, 4) + little(0xff00, 4) + little(0xff, 4);
  for (const std::string& bytes : {bmp(3, 2, 24, pixels_of(3, false)), bmp(3, -2, 24, pixels_of(3, true)),
                                   bmp(3, 2, 32, pixels_of(4, false)), bmp(3, 2, 32, pixels_of(4, false), 3, masks)}) {
    const render::Image image = read(bytes);
    ASSERT_EQ(image.width, 3);
    ASSERT_EQ(image.height, 2);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        EXPECT_TRUE(image.at(x, y).isApprox(render::Spectrum(float(y), float(x), 7) / 255)) << x << " " << y;
  }
  EXPECT_NEAR(render::read_image(write("b.bmp", bmp(1, 1, 24, "\x80\x80\x80"))).at(0, 0)[0], 0.2158605, 1e-6) << "sRGB";
}

TEST_F(Bmp, BrokenFilesAreRefused) {
  const std::string pixels = pixels_of(3, false);
  EXPECT_THAT(refusal("PM"), HasSubstr("a.bmp: not a BMP file"));
  EXPECT_THAT(refusal("BM" + std::string(50, '\0')), HasSubstr("BMP header ends early: 52 bytes of 54"));
  EXPECT_THAT(refusal(bmp(3, 2, 8, pixels)), HasSubstr("BMP has 8 bits per pixel; save it with 24 or 32"));
  EXPECT_THAT(refusal(bmp(3, 2, 24, pixels, 1)), HasSubstr("BMP has the compression 1"));
  EXPECT_THAT(refusal(bmp(3, 2, 32, pixels_of(4, false), 3, std::string(12, '\1'))), HasSubstr("in another order"));
  EXPECT_THAT(refusal(bmp(0, 2, 24, pixels)), HasSubstr("BMP says 0x2; at least one pixel is needed"));
  EXPECT_THAT(refusal(bmp(3, INT32_MIN, 24, pixels)), HasSubstr("BMP says 3x-2147483648"));
  EXPECT_THAT(refusal(bmp(INT32_MAX, INT32_MAX, 32, pixels)), HasSubstr("which its 78 bytes cannot hold"));
  EXPECT_THAT(refusal(bmp(3, 3, 24, pixels)), HasSubstr("BMP says 3x3 pixels from byte 54 on, which its 78 bytes"));
  const std::string whole = bmp(3, 2, 24, pixels);
  for (std::size_t n = 0; n + 4 < whole.size(); ++n) EXPECT_NE(refusal(whole.substr(0, n)), "") << n;
}

} // namespace
