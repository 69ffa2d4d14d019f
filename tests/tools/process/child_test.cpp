#include <process/child.h>

#include <gtest/gtest.h>

namespace {

TEST(ChildProcess, PeakMemoryIsThatOfTheLargestDescendant) {
  carlo::ChildProcess child({{"/bin/sh", "-c", "python3 -c \"x = b'x' * (64 << 20)\"; exit 3"}});
  EXPECT_EQ(child.peak_memory(), 0);
  EXPECT_EQ(child.wait(), 3);
  EXPECT_GE(child.peak_memory(), 64 << 20);
  EXPECT_LE(child.peak_memory(), 1e12);
}

} // namespace
