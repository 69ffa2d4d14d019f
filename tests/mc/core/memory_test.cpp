#include <mc/core/memory.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

#include <sys/resource.h>

namespace {

TEST(Memory, AllowsHalfOfTheMachineUnlessThereIsALimit) {
  EXPECT_GE(mc::allowed_memory(), 0x1p25);
  EXPECT_LE(mc::allowed_memory(), 0x1p50);
  rlimit before{};
  getrlimit(RLIMIT_DATA, &before);
  mc::limit_memory(0x1p60); // far above the reservations of sanitizers
  EXPECT_EQ(mc::allowed_memory(), 0x1p60);
  mc::require_memory(0x1p60, "10 pixels");
  try {
    mc::require_memory(0x1p61, "10 pixels");
    ADD_FAILURE() << "no error";
  } catch (const mc::Error& e) {
    EXPECT_STREQ(e.what(), "10 pixels need 2.15e+09 GiB of memory; 1.07e+09 GiB are allowed (--memory)");
  }
  setrlimit(RLIMIT_DATA, &before);
}

} // namespace
