#include <terminal/progress.h>

#include <terminal/columns.h>

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace {

using carlo::progress_line;

TEST(Progress, FormatsSecondsAndMinutes) {
  EXPECT_EQ(carlo::format_seconds(0.85), "850 ms");
  EXPECT_EQ(carlo::format_seconds(12.34), "12.3 s");
  EXPECT_EQ(carlo::format_seconds(245), "4 min 05 s");
  EXPECT_EQ(carlo::format_seconds(59.97), "1 min 00 s");
  EXPECT_EQ(carlo::format_seconds(3599.9), "1 h 00 min");
  EXPECT_EQ(carlo::format_seconds(50'000), "13 h 53 min");
  EXPECT_EQ(carlo::format_seconds(1e6), "11 d 14 h");
  EXPECT_EQ(carlo::format_seconds(1e12), "31688 years");
}

TEST(Progress, FormatsCountsWithThreeDigits) {
  EXPECT_EQ(carlo::format_count(0), "0");
  EXPECT_EQ(carlo::format_count(950), "950");
  EXPECT_EQ(carlo::format_count(999.9), "1 k");
  EXPECT_EQ(carlo::format_count(12345), "12.3 k");
  EXPECT_EQ(carlo::format_count(4.56e6), "4.56 M");
  EXPECT_EQ(carlo::format_count(7.8e9), "7.8 G");
}

TEST(ProgressLine, ShrinksItsBarBeforeItsText) {
  EXPECT_EQ(progress_line(0.5, "1 min 00 s left", "error 1.23 %", 80),
            "[============            ]  50 %  1 min 00 s left  error 1.23 %");
  EXPECT_EQ(progress_line(0.5, "1 min 00 s left", "error 1.23 %", 50),
            "[======     ]  50 %  1 min 00 s left  error 1.23 %");
}

TEST(ProgressLine, LeavesOutWholeParts) {
  const std::string text = "error 1.23 %  at most 4.5 %  881 ksamples/s";
  EXPECT_EQ(progress_line(1, "0 ms left", text, 44), "[===========] 100 %  0 ms left  error 1.23 %");
  EXPECT_EQ(progress_line(0, "", "book3-cornell-glass mis sobol, 64 spp", 40),
            "[     ]   0 %    book3-cornell-glass mis");
}

// Every word of the line is also a word of the widest line: no number is cut.
TEST(ProgressLine, CutsNoNumber) {
  const std::string text = "1.3075149 \u00b1 0.00013  error 12.34 %  at most 61.2 %  881 ksamples/s";
  for (std::size_t columns = 30; columns < 120; ++columns) {
    const std::string line = progress_line(0.37, "4 min 05 s left", text, columns);
    EXPECT_LE(carlo::columns_of(line), std::max<std::size_t>(columns, 36)) << line;
    const std::size_t from = line.find("left  ") + 6;
    const std::string shown = line.substr(from);
    EXPECT_TRUE(text.starts_with(shown)) << line;
    EXPECT_TRUE(shown.empty() || shown.size() == text.size() || text[shown.size()] == ' ') << line;
  }
}

} // namespace
