#include <render/io/image/formats.h>

#include "support/files.h"

namespace {

struct Formats : support::ScratchTest {};

// The tests of image_io.h cover the formats. This test covers big-endian and grey PFM files.
TEST_F(Formats, BigEndianGreyPfm) {
  std::string bytes = "Pf\n2 1\n1.0\n";
  bytes += std::string("\x3f\x80\x00\x00\x40\x00\x00\x00", 8); // 1.0f, 2.0f
  write("grey.pfm", bytes);
  const render::Image image = render::formats::read_pfm(path("grey.pfm"));
  EXPECT_EQ(image.at(0, 0)[1], 1.0f);
  EXPECT_EQ(image.at(1, 0)[2], 2.0f);
}

// Also lines that end in a carriage return, and comment lines.
TEST_F(Formats, HeadersOfPfm) {
  const std::string pixels("\x00\x00\x80\x3f\x0a\x00\x80\x3f", 8); // 1.0f, and 1.0f plus 10 ulp
  for (const char* header : {"Pf\n2 1\n-1.0\n", "Pf\r\n2 1\r\n-1.0\r\n", "Pf 2 1 -1 ", "Pf 2 1 -1\r\n",
                             "Pf\n# by hand\n#\n2 1\n# and\n-1\n", "Pf\r2 1\r-1\r"}) {
    const render::Image image = render::formats::read_pfm(write("a.pfm", header + pixels));
    EXPECT_EQ(image.at(0, 0)[0], 1.0f) << header;
    EXPECT_EQ(image.at(1, 0)[0], render::Float(1 + 10 * 0x1p-23)) << header;
  }
  const auto refusal = [&](const std::string& text) {
    return support::error_of([&] { render::formats::read_pfm(write("b.pfm", text)); });
  };
  EXPECT_THAT(refusal("Pf\n2 1\n-1\n" + pixels + "x"),
              testing::HasSubstr("PFM data goes on: 9 bytes where 2x1 pixels"));
  EXPECT_THAT(refusal("Pf\r\n2 1\r\n-1\r\n" + pixels.substr(1)),
              testing::HasSubstr("PFM data ends early: 7 bytes of 8"));
  EXPECT_THAT(refusal("Pf\n2.5 1\n-1\n" + pixels), testing::HasSubstr("PFM header says 2.5x1, scale -1"));
  EXPECT_THAT(refusal("Pf\n0 1\n-1\n"), testing::HasSubstr("PFM header says 0x1"));
  EXPECT_THAT(refusal("Pf\n2 1\n-1"), testing::HasSubstr("PFM data ends early: 0 bytes of 8"));
  EXPECT_THAT(refusal("Pf # 2 1"), testing::HasSubstr("not a PFM file"));
}

// Flat images with DWA compression: 1024x256 pixels of 0.5 in 27 channels, in 1813 bytes.
TEST_F(Formats, FlatExrUnderDwa) {
  const render::Image image = render::formats::read_exr(MC_SOURCE_DIR "/tests/render/io/image/flat-dwab.exr");
  EXPECT_EQ(image.layers.size(), 24u);
  EXPECT_NEAR(image.at(1023, 255)[1], 0.5, 1e-3); // DWA is lossy
}

} // namespace
