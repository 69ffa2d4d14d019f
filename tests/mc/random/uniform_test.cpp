#include <mc/random/uniform.h>

#include <gtest/gtest.h>

namespace {

TEST(Uniform, EndsAreExact) {
  EXPECT_EQ(mc::uniform<float>(0), 0.0f);
  EXPECT_EQ(mc::uniform<double>(0), 0.0);
  EXPECT_EQ(mc::uniform<float>(~0ULL), mc::one_minus_epsilon<float>);
  EXPECT_EQ(mc::uniform<double>(~0ULL), mc::one_minus_epsilon<double>);
}

TEST(Uniform, IsTheLeadingBits) {
  for (std::uint64_t k = 1; k < 1000; ++k) {
    const std::uint64_t bits = mc::mix64(k);
    EXPECT_EQ(mc::uniform<float>(bits) * 0x1p24f, static_cast<float>(bits >> 40));
    EXPECT_EQ(mc::uniform<double>(bits) * 0x1p53, static_cast<double>(bits >> 11));
    EXPECT_LE(mc::uniform<float>(bits), mc::uniform<double>(bits));
  }
}

TEST(Uniform, OpenOneIsInside) {
  EXPECT_EQ(mc::open_uniform<float>(0), 0x1p-25f);
  EXPECT_EQ(mc::open_uniform<double>(0), 0x1p-54);
  EXPECT_EQ(mc::open_uniform<float>((1ULL << 40) - 1), 0x1p-25f);
  EXPECT_EQ(mc::open_uniform<double>(1ULL << 11), 0x1p-53);
  EXPECT_EQ(mc::open_uniform<float>(~0ULL), mc::one_minus_epsilon<float>);
  for (std::uint64_t k = 1; k < 1000; ++k)
    EXPECT_EQ(mc::open_uniform<float>(mc::mix64(k)), mc::uniform<float>(mc::mix64(k)));
}

TEST(Uniform, HashedIsAFunctionOfItsKey) {
  EXPECT_EQ(mc::hash_uniform<double>(1, 2, 3), mc::hash_uniform<double>(1, 2, 3));
  EXPECT_NE(mc::hash_uniform<double>(1, 2, 3), mc::hash_uniform<double>(1, 3, 2));
}

} // namespace
