#include <process/child.h>

#include <gtest/gtest.h>

namespace {

TEST(Child, ItsPeakIsThatOfTheLargestItWaitedFor) {
  carlo::Child child({{"/bin/sh", "-c", "python3 -c \"x = b'x' * (64 << 20)\"; exit 3"}});
  EXPECT_EQ(child.peak(), 0);
  EXPECT_EQ(child.wait(), 3);
  EXPECT_GE(child.peak(), 64 << 20);
  EXPECT_LE(child.peak(), 1e12);
}

} // namespace
