#include <render/io/image/srgb.h>

#include <gtest/gtest.h>

namespace {

TEST(Srgb, KnownValues) {
  EXPECT_EQ(render::srgb_to_linear(0), 0);
  EXPECT_EQ(render::srgb_to_linear(1), 1);
  EXPECT_NEAR(render::srgb_to_linear(0.5), 0.21404114, 1e-8);
  // The linear segment at the dark end, where a power of 2.2 is far too low.
  EXPECT_NEAR(render::srgb_to_linear(8 / 255.0), 8 / 255.0 / 12.92, 1e-15);
}

TEST(Srgb, EightBitCodesComeBack) {
  for (int code = 0; code < 256; ++code)
    EXPECT_NEAR(255 * render::linear_to_srgb(render::srgb_to_linear(code / 255.0)), code, 1e-5 * 255);
}

} // namespace
