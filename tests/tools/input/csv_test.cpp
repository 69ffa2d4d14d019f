#include <input/csv.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::ElementsAre, testing::HasSubstr;

struct Csv : support::ScratchTest {
  carlo::CsvTable table(const std::string& text) const { return carlo::read_csv(write("a.csv", text)); }
  std::string refusal(const std::string& text) const {
    return support::error_of([&] { table(text); });
  }
};

TEST_F(Csv, HeaderRow_IsSkipped) {
  for (const char* names :
       {"x,y", "\"x\",\"y\"", "\" x [m]\",\"y, of 2\"", "_1;_2", "\"\xcf\x86\",\"n #\"", "\"x\" # names"})
    EXPECT_THAT(table(std::string(names) + "\n0.5,0.25\n").values, ElementsAre(0.5, 0.25)) << names;
}

TEST_F(Csv, AnyLineEnding_IsAccepted) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string text = std::string("x,y") + end + "0.5,0.25" + end + "1,2" + end;
    EXPECT_THAT(table(text).values, ElementsAre(0.5, 0.25, 1, 2));
    EXPECT_THAT(refusal(text + "1,nan"), HasSubstr("a.csv:4: 'nan' is not a finite number"));
  }
}

// A first row of numbers is never read as column names, even if it has errors.
TEST_F(Csv, NumericFirstRow_IsKept) {
  for (const char* row : {"0.5,0.25", "\"0.5\",\"0.25\"", "\" 0.5 \", 0.25", "+.5,2.5e-1", "0.5,0.25 # \"a\" note"})
    EXPECT_THAT(table(std::string(row) + "\n1,2\n").values, ElementsAre(0.5, 0.25, 1, 2)) << row;
  EXPECT_THAT(refusal("\"0.5,0.25\n1,2\n"), HasSubstr("a.csv:1: a quotation mark without its other"));
  EXPECT_THAT(refusal("\"x,y\n1,2\n"), HasSubstr("a.csv:1: a quotation mark without its other"));
  EXPECT_THAT(refusal("x,\"y\n1,2\n"), HasSubstr("a.csv:1: a quotation mark without its other"));
  EXPECT_THAT(refusal("\"nan\",1\n1,2\n"), HasSubstr("a.csv:1: 'nan' is not a finite number"));
  EXPECT_THAT(refusal("\"\",1\n1,2\n"), HasSubstr("a.csv:1: an empty field"));
  EXPECT_THAT(refusal("\"0.5 m\",1\n1,2\n"), HasSubstr("a.csv:1: '0.5 m' is not a number"));
  EXPECT_THAT(refusal("\xe2\x88\x92"
                      "0.5,1\n1,2\n"),
              HasSubstr("a.csv:1: '\xe2\x88\x92"
                        "0.5' is not a number"))
      << "U+2212";
}

TEST_F(Csv, DecimalComma_IsRejectedWithRemedy) {
  EXPECT_THAT(refusal("1;2\n0,5;0,25\n"), HasSubstr("a.csv:2: both ',' and ';' separate; write decimal points"));
  EXPECT_THAT(refusal("\"0,5\",\"0,25\"\n"), HasSubstr("a.csv:1: '0,5' has a decimal comma; write a decimal point"));
  EXPECT_THAT(refusal("x,y\n1,2\n0.5,\"-1,25e3\"\n"),
              HasSubstr("a.csv:3: '-1,25e3' has a decimal comma; write a decimal point"));
  EXPECT_THAT(refusal("\"0,5,1\",2\n"), HasSubstr("a.csv:1: '0,5,1' is not a number"));
}

// The place value of the last digit, if programs omit trailing zeros.
TEST_F(Csv, Digits_FollowColumn) {
  EXPECT_THAT(table("0.25\n0.5\n0.125\n1\n").digits, ElementsAre(-3, -3, -3, -2)) << "three significant digits";
  EXPECT_THAT(table("0.123456\n1.5\n12.25\n0.00123456\n1e-09\n").digits, ElementsAre(-6, -5, -4, -8, -9))
      << "%g: six significant digits";
  EXPECT_THAT(table("0.123456\n1\n10\n0.1\n0.00123456\n").digits_below, ElementsAre(-6, -6, -5, -7, -8)) << "below 1";
  EXPECT_THAT(table("0.123\n12.500\n100.000\n").digits, ElementsAre(-3, -3, -3)) << "%.3f";
  EXPECT_THAT(table("0.5,0.25\n0.125,1e-3\n").digits, ElementsAre(-3, -2, -3, -3)) << "each column for itself";
  EXPECT_THAT(table("1\n20\n300\n").digits, ElementsAre(0, 0, 0)) << "whole numbers";
}

} // namespace
