#include <terminal/progress.h>

#include <gtest/gtest.h>

namespace {

TEST(Progress, SecondsReadAsPeopleWriteThem) {
  EXPECT_EQ(carlo::format_seconds(0.85), "850 ms");
  EXPECT_EQ(carlo::format_seconds(12.34), "12.3 s");
  EXPECT_EQ(carlo::format_seconds(245), "4 min 05 s");
  EXPECT_EQ(carlo::format_seconds(59.97), "1 min 00 s");
}

TEST(Progress, CountsKeepThreeDigits) {
  EXPECT_EQ(carlo::format_count(0), "0");
  EXPECT_EQ(carlo::format_count(950), "950");
  EXPECT_EQ(carlo::format_count(999.9), "1 k");
  EXPECT_EQ(carlo::format_count(12345), "12.3 k");
  EXPECT_EQ(carlo::format_count(4.56e6), "4.56 M");
  EXPECT_EQ(carlo::format_count(7.8e9), "7.8 G");
}

} // namespace
