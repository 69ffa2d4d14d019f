// TGA images, written here in the encodings of the format.

#include <render/io/image/image_io.h>

#include "support/files.h"

namespace {

using testing::HasSubstr;

struct Settings {
  int type = 2, width = 3, height = 2, bits = 24, descriptor = 0;
  std::string text = {};
  int palette = 0;
};

std::string header(const Settings& s) {
  const auto word = [](int n) { return std::string{static_cast<char>(n), static_cast<char>(n >> 8)}; };
  const auto byte = [](int n) { return std::string(1, static_cast<char>(n)); };
  return byte(static_cast<int>(s.text.size())) + byte(s.palette > 0) + byte(s.type) + word(0) + word(s.palette) +
         byte(24) + word(0) + word(0) + word(s.width) + word(s.height) + byte(s.bits) + byte(s.descriptor) + s.text +
         std::string(static_cast<std::size_t>(3 * s.palette), '\x44');
}
// Pixels with the codes (red, green, blue) = (row, column, 7), or grey row + 2 column, in the order of the file.
std::string pixel(int row, int column, int bits) {
  if (bits == 8) return std::string(1, static_cast<char>(row + 2 * column));
  return std::string{7, static_cast<char>(column), static_cast<char>(row)} + std::string(bits == 32 ? 1 : 0, '\x55');
}
std::string plain(int bits) {
  std::string all;
  for (int i = 0; i < 6; ++i) all += pixel(i / 3, i % 3, bits);
  return all;
}

struct Tga : support::ScratchTest {
  render::Image read(const std::string& bytes) const { return render::read_image(write("a.tga", bytes), {{1.0}}); }
  std::string refusal(const std::string& bytes) const {
    const std::string said = support::error_of([&] { read(bytes); });
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
  }
};

TEST_F(Tga, RowsAndColumnsFollowTheDescriptor) {
  for (const int descriptor : {0, 16, 32, 48})
    for (const int bits : {24, 32, 8}) {
      const render::Image image = read(
          header({.type = bits == 8 ? 3 : 2, .bits = bits, .descriptor = descriptor, .text = "by hand", .palette = 2}) +
          plain(bits));
      ASSERT_EQ(image.width, 3);
      ASSERT_EQ(image.height, 2);
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
          const int row = descriptor & 32 ? y : 1 - y, column = descriptor & 16 ? 2 - x : x;
          const render::Spectrum codes = bits == 8
                                             ? render::Spectrum(render::Spectrum::Constant(float(row + 2 * column)))
                                             : render::Spectrum(float(row), float(column), 7);
          EXPECT_TRUE(image.at(x, y).isApprox(codes / 255)) << descriptor << " " << bits << " " << x << " " << y;
        }
    }
}

// A packet of two equal pixels, one of three different pixels, and one of one pixel.
TEST_F(Tga, RunsAreUnpacked) {
  for (const int bits : {24, 32, 8}) {
    const std::string packed = '\x81' + pixel(1, 2, bits) + '\2' + pixel(0, 1, bits) + pixel(1, 1, bits) +
                               pixel(0, 0, bits) + '\x80' + pixel(1, 0, bits);
    const std::string start = header({.type = bits == 8 ? 11 : 10, .bits = bits, .descriptor = 32});
    const render::Image image = read(start + packed),
                        expected = read(header({.type = bits == 8 ? 3 : 2, .bits = bits, .descriptor = 32}) +
                                        pixel(1, 2, bits) + pixel(1, 2, bits) + pixel(0, 1, bits) + pixel(1, 1, bits) +
                                        pixel(0, 0, bits) + pixel(1, 0, bits));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE((image.pixels[i] == expected.pixels[i]).all()) << bits << " " << i;
    for (std::size_t n = 0; n < start.size() + packed.size(); ++n)
      EXPECT_NE(refusal((start + packed).substr(0, n)), "") << n;
  }
}

TEST_F(Tga, BrokenFilesAreRefused) {
  EXPECT_THAT(refusal("TGA"), HasSubstr("a.tga: TGA data ends early"));
  EXPECT_THAT(refusal(header({.type = 1}) + plain(24)), HasSubstr("TGA of type 1 is not supported"));
  EXPECT_THAT(refusal(header({.bits = 16}) + plain(24)), HasSubstr("TGA has 16 bits per pixel; save it with 24 or 32"));
  EXPECT_THAT(refusal(header({.type = 3}) + plain(24)), HasSubstr("TGA has 24 bits per pixel; save it with 8"));
  EXPECT_THAT(refusal(header({.width = 0}) + plain(24)), HasSubstr("TGA says 0x2; at least one pixel is needed"));
  EXPECT_THAT(refusal(header({.width = 65535, .height = 65535}) + plain(24)),
              HasSubstr("TGA says 65535x65535, which its 36 bytes cannot hold"));
  EXPECT_THAT(refusal(header({.type = 10, .width = 65535, .height = 65535}) + plain(24)),
              HasSubstr("TGA says 65535x65535, which its 36 bytes cannot hold"));
}

} // namespace
