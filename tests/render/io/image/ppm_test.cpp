// Netpbm images, binary and text.

#include <render/io/image/image_io.h>

#include "support/files.h"

namespace {

using testing::HasSubstr;

struct Ppm : support::ScratchTest {
  render::Image read(const std::string& bytes) const { return render::read_image(write("a.ppm", bytes), {{1.0}}); }
  std::string refusal(const std::string& bytes) const {
    const std::string said = support::error_of([&] { read(bytes); });
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
  }
};

TEST_F(Ppm, BinaryAndTextAreTheSame) {
  const std::string wide("\1\0\0\x10\0\x20\1\0\1\0\0\0", 12); // 256 16 32, 256 256 0
  for (const std::string& bytes : {"P6\n2 1\n512\n" + wide, std::string("P3 2 1 512\n256 16 32\n256 256 0"),
                                   std::string("P3\n# by hand\n2 1 # wide\n#\n512\n256\t16\r\n32 # red\n256 256 0\n"),
                                   "P6 2 1 512\t" + wide + "\n"}) {
    const render::Image image = read(bytes);
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 1);
    EXPECT_TRUE((image.at(0, 0) == render::Spectrum(0.5f, 0.03125f, 0.0625f)).all()) << bytes;
    EXPECT_TRUE((image.at(1, 0) == render::Spectrum(0.5f, 0.5f, 0)).all()) << bytes;
  }
  for (const std::string& bytes : {std::string("P5 1 2 4 \1\4", 11), std::string("P2 1 2 4 1 4")}) {
    const render::Image image = render::read_image(write("a.pgm", bytes), {{1.0}});
    EXPECT_TRUE((image.at(0, 0) == 0.25f).all()) << bytes;
    EXPECT_TRUE((image.at(0, 1) == 1).all()) << bytes;
  }
  EXPECT_NEAR(render::read_image(write("b.pgm", "P2 1 1 2 1")).at(0, 0)[0], 0.214041, 1e-6) << "sRGB";
}

TEST_F(Ppm, BrokenFilesAreRefused) {
  EXPECT_THAT(refusal("P1 1 1 1"), HasSubstr("a.ppm: not a PPM or PGM file"));
  EXPECT_THAT(refusal("P6"), HasSubstr("PPM: a number is missing: the width"));
  EXPECT_THAT(refusal("P6 # 2 1"), HasSubstr("PPM: a number is missing: the width"));
  EXPECT_THAT(refusal("P6 -1 1 255 "), HasSubstr("PPM: a number is missing: the width"));
  EXPECT_THAT(refusal("P6 99999999999999999999 1 255 "), HasSubstr("PPM: the width exceeds 2147483647"));
  EXPECT_THAT(refusal("P6 1 1 65536 "), HasSubstr("PPM: the largest code exceeds 65535"));
  EXPECT_THAT(refusal("P6 0 1 255 "), HasSubstr("PPM says 0x1 pixels up to the code 255; all must be at least 1"));
  EXPECT_THAT(refusal("P6 1 1 0 "), HasSubstr("up to the code 0"));
  for (const char* kind : {"P2", "P3", "P5", "P6"})
    EXPECT_THAT(refusal(std::string(kind) + " 2147483647 2147483647 255\n12345678"), HasSubstr("bytes cannot hold"));
  EXPECT_THAT(refusal("P6 2 1 255\n12345"), HasSubstr("PPM says 2x1, which its 16 bytes cannot hold"));
  EXPECT_THAT(refusal("P5 2 1 65535\n123"), HasSubstr("PPM says 2x1, which its 16 bytes cannot hold"));
  EXPECT_THAT(refusal("P5 1 1 9\n:"), HasSubstr("PPM: the code 58 exceeds 9"));
  EXPECT_THAT(refusal("P2 1 1 9\n10"), HasSubstr("PPM: a code exceeds 9"));
  EXPECT_THAT(refusal("P2 2 1 9\n1 x "), HasSubstr("PPM: a number is missing: a code"));
}

} // namespace
