#include <mc/core/cpu_time.h>

#include <gtest/gtest.h>

namespace {

TEST(CpuTime, GrowsWithWork) {
  const double start = mc::thread_cpu_seconds();
  volatile unsigned spin = 0;
  while (mc::thread_cpu_seconds() < start + 0.01) spin = spin + 1;
  EXPECT_GT(spin, 0u);
  const double of_thread = mc::thread_cpu_seconds();
  EXPECT_GE(mc::clock_seconds(CLOCK_PROCESS_CPUTIME_ID), of_thread);
}

TEST(CpuTime, UnknownClockIsZero) { EXPECT_EQ(mc::clock_seconds(static_cast<clockid_t>(12345)), 0); }

} // namespace
