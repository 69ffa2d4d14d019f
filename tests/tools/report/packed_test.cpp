#include <report/packed.h>

#include <tools/unpacked.h>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace {

// 1 is 3f800000 and -2.5 is c0200000, lowest bytes first.
TEST(Packed, StoresTheBytesOfFloatsInPlanes) {
  const std::string bytes = support::unpacked(carlo::packed("ab", {1.0F, -2.5F}));
  EXPECT_EQ(bytes, std::string("ab\0\0\0\0\x80\x20\x3f\xc0", 10));
  EXPECT_EQ(support::unpacked(carlo::packed("", {})), "");
}

TEST(Packed, KeepsEveryBit) {
  std::vector<float> numbers;
  for (std::uint32_t i = 0; i < 999; ++i) numbers.push_back(std::bit_cast<float>(i * 2654435761u >> 1));
  const std::string bytes = support::unpacked(carlo::packed("", numbers));
  ASSERT_EQ(bytes.size(), 4 * numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k)
      bits |= std::uint32_t{static_cast<unsigned char>(bytes[k * numbers.size() + i])} << 8 * k;
    ASSERT_EQ(bits, std::bit_cast<std::uint32_t>(numbers[i])) << i;
  }
}

} // namespace
