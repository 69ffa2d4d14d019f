#include <mc/core/dot.h>

#include <gtest/gtest.h>

namespace mc {
namespace {

TEST(AccurateDot, SurvivesCancellationInFloatAndDouble) {
  const float f = 1 + 0x1p-12f;
  EXPECT_EQ(accurate_dot<float>({f, 1, 0}, {f, -1 - 0x1p-11f, 0}), 0x1p-24f);
  const double d = 1 + 0x1p-27;
  EXPECT_EQ(accurate_dot<double>({d, 1, 0}, {d, -1 - 0x1p-26, 0}), 0x1p-54);
  EXPECT_EQ(accurate_dot<double>({1e16, 1, -1e16}, {1, 1, 1}), 1.0);
}

} // namespace
} // namespace mc
