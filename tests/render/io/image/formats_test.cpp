#include <render/io/image/formats.h>

#include "support/files.h"

namespace {

struct Formats : support::ScratchTest {};

// Through image_io.h everything is tested; here only that a big-endian and a grey PFM are understood.
TEST_F(Formats, BigEndianGreyPfm) {
  std::string bytes = "Pf\n2 1\n1.0\n";
  bytes += std::string("\x3f\x80\x00\x00\x40\x00\x00\x00", 8); // 1.0f, 2.0f
  write("grey.pfm", bytes);
  const render::Image image = render::formats::read_pfm(path("grey.pfm"));
  EXPECT_EQ(image.at(0, 0)[1], 1.0f);
  EXPECT_EQ(image.at(1, 0)[2], 2.0f);
}

} // namespace
