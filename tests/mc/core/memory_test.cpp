#include <mc/core/memory.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

namespace {

// The type of the error remains where a caller adds the place.
std::string refusal(double bytes, std::string_view remedy) {
  try {
    mc::with_context("a.png", [&] { mc::require_memory(bytes, "10 pixels", remedy); });
  } catch (const mc::MemoryError& e) {
    return e.what();
  }
  return "";
}

TEST(Memory, AllowsHalfOfTheMachineUnlessThereIsALimit) {
  EXPECT_GE(mc::allowed_memory(), 0x1p25);
  EXPECT_LE(mc::allowed_memory(), 0x1p50);
  rlimit before{};
  getrlimit(RLIMIT_DATA, &before);
  mc::limit_memory(0x1p60); // far above the reservations of sanitizers
  EXPECT_EQ(mc::allowed_memory(), 0x1p60);
  mc::require_memory(0x1p59, "10 pixels");
  EXPECT_EQ(refusal(0x1p61, ""), "a.png: 10 pixels need 2.15e+09 GiB of memory; 1.07e+09 GiB are allowed");
  EXPECT_EQ(refusal(0x1p61, "take 9"),
            "a.png: 10 pixels need 2.15e+09 GiB of memory; 1.07e+09 GiB are allowed; take 9");
  EXPECT_THAT(
      refusal(0x1p60, ""), // memory in use counts, too
      testing::MatchesRegex(".*need 1.07e.09 GiB of memory beside the [0-9.e+]+ GiB in use; 1.07e.09 GiB are.*"));
  setrlimit(RLIMIT_DATA, &before);
}

} // namespace
