#include <render/io/image/transfer.h>

#include <gtest/gtest.h>

namespace {

TEST(Transfer, IsThePowerOrTheCurveOfSrgb) {
  EXPECT_EQ(render::Transfer{1.0}.to_linear(0.3), 0.3);
  EXPECT_NEAR(render::Transfer{2.2}.to_linear(0.5), 0.217637640824031, 1e-15);
  EXPECT_NEAR(render::Transfer().to_linear(0.5), 0.214041140482232, 1e-15);
  const auto table = render::Transfer{2.0}.table();
  for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(table[i], render::Float(double(i * i) / 65025)) << i;
}

} // namespace
