#include <terminal/columns.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

TEST(Columns, BreaksTextBetweenWords) {
  EXPECT_EQ(carlo::wrapped("one two three", 9), "one two\nthree\n");
  EXPECT_EQ(carlo::wrapped("one two three", 9, 2), "  one two\n  three\n");
  EXPECT_EQ(carlo::wrapped("incomprehensible word", 5), "incomprehensible\nword\n") << "a word is never cut";
  EXPECT_EQ(carlo::wrapped("a\nb  c", 80), "a\nb c\n");
  EXPECT_EQ(carlo::wrapped("", 80), "");
}

TEST(Columns, CountsCharactersNotBytes) {
  EXPECT_EQ(carlo::columns_of("1 \u00b1 2"), 5u);
  EXPECT_EQ(carlo::wrapped("\u00b1\u00b1\u00b1 \u00b1\u00b1", 6), "\u00b1\u00b1\u00b1 \u00b1\u00b1\n");
}

TEST(Columns, ATermStandsBeforeItsTextOrAbove) {
  EXPECT_EQ(carlo::term_row("-n N", "how many of them", 20, 2, 8), "  -n N  how many of\n        them\n");
  EXPECT_EQ(carlo::term_row("--long N", "how many", 20, 2, 8), "  --long N\n        how many\n");
}

TEST(Columns, TheVariableColumnsDecidesWhereItIsANumber) {
  setenv("COLUMNS", "100", 1);
  EXPECT_EQ(carlo::terminal_columns(-1), 100u);
  for (const char* unusable : {"", "wide", "-5", "3", "1e9", "80.5"}) {
    setenv("COLUMNS", unusable, 1);
    EXPECT_EQ(carlo::terminal_columns(-1), 80u) << unusable;
  }
  unsetenv("COLUMNS");
  EXPECT_EQ(carlo::terminal_columns(-1), 80u);
}

} // namespace
