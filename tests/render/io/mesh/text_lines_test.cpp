#include <render/io/mesh/text_lines.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace render;

TEST(TextLines, WordsAndNames) {
  std::string_view rest = "  one\ttwo  three four  ";
  EXPECT_EQ(next_word(rest), "one");
  EXPECT_EQ(next_word(rest), "two");
  EXPECT_EQ(rest_of_line(rest), "three four");
  EXPECT_EQ(rest_of_line(" \t"), "");
  rest = {};
  EXPECT_EQ(next_word(rest), "");
}

TEST(TextLines, LinesHaveNumbersAndKeywords) {
  std::vector<std::string> seen;
  for_each_line(with_plain_ends("v 1 # x\r\n\r# all\rf  2 3"), [&](std::size_t line, std::string_view word,
                                                                   std::string_view rest) {
    seen.push_back(std::to_string(line) + ":" + std::string(word) + "|" + std::string(rest_of_line(rest)));
  });
  EXPECT_EQ(seen, (std::vector<std::string>{"1:v|1", "2:|", "3:|", "4:f|2 3"}));
}

} // namespace
