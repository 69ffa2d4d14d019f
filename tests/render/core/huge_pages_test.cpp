#include <render/core/huge_pages.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace {

struct alignas(64) Line {
  std::uint64_t value;
};

// Arrays below, at and above the threshold for huge pages, and arrays that grow across it.
TEST(HugePageAllocator, ArraysOfAnySizeHoldWhatIsPutIntoThem) {
  constexpr std::size_t page = std::size_t{1} << 21;
  for (const std::size_t bytes : {std::size_t{64}, page, 16 * page - 64, 16 * page, 17 * page + 64}) {
    std::vector<Line, render::HugePageAllocator<Line>> lines;
    for (std::size_t i = 0; i < bytes / sizeof(Line); ++i) lines.push_back({i});
    lines.shrink_to_fit();
    const auto copy = lines;
    lines = {};
    for (std::size_t i = 0; i < copy.size(); ++i) ASSERT_EQ(copy[i].value, i) << bytes;
    const std::size_t boundary = bytes >= 16 * page ? page : alignof(Line);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(copy.data()) % boundary, 0u) << bytes;
  }
}

} // namespace
