#include <mc/check/subject/options.h>

#include <gtest/gtest.h>

namespace {

// A suite of a hundred correct distributions passes nine times in ten.
TEST(SubjectOptions, DefaultAlpha_SuitsASuite) {
  const mc::SubjectOptions options;
  EXPECT_EQ(options.alpha, 0.001);
  EXPECT_GE(options.samples, 1000u);
  EXPECT_EQ(options.before_draws, nullptr);
}

} // namespace
