#include <mc/random/joined.h>

#include <gtest/gtest.h>

namespace {

TEST(Joined, SecondNumberRefinesTheFirst) {
  EXPECT_EQ(mc::joined(mc::Vec2<float>(0, 0)), 0);
  EXPECT_EQ(mc::joined(mc::Vec2<float>(0.5f, 0.5f)), 0.5 + 0x1p-25);
  const float last = mc::one_minus_epsilon<float>;
  EXPECT_EQ(mc::joined(mc::Vec2<float>(last, last)), 1 - 0x1p-48);
  EXPECT_LT(mc::joined(mc::Vec2<double>(mc::one_minus_epsilon<double>, mc::one_minus_epsilon<double>)), 1);
}

} // namespace
