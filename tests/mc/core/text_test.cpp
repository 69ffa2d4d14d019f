#include <mc/core/text.h>

#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

TEST(Text, ParsesNumbers) {
  struct Row {
    const char* text;
    double value;
  };
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const Row& row : {Row{"0.1", 0.1},
                         {"+2.2", 2.2},
                         {"-3", -3},
                         {".5", 0.5},
                         {"5.", 5},
                         {"1e-3", 1e-3},
                         {"+1E+3", 1e3},
                         {"inf", inf},
                         {"-inf", -inf},
                         {"1e-400", 0},
                         {"4.9406564584124654e-324", 4.9406564584124654e-324}})
    EXPECT_EQ(mc::parse_double(row.text), row.value) << row.text;
  EXPECT_TRUE(std::signbit(mc::parse_double("-1e-400").value()));
  EXPECT_TRUE(std::isnan(mc::parse_double("nan").value()));
  for (const char* text : {"", "+", "-", "+-1", "++1", "-+1", "1 ", " 1", "1,5", "1e", "0x10", "one", "1.2.3", "e5",
                           "1e5x", "1e400", "-1e400"})
    EXPECT_EQ(mc::parse_double(text), std::nullopt) << text;
}

TEST(Text, Trimmed) {
  EXPECT_EQ(mc::trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(mc::trimmed("a"), "a");
  EXPECT_EQ(mc::trimmed(" \n"), "");
  EXPECT_EQ(mc::trimmed(""), "");
}

TEST(Text, SplitIntoWordsWithoutBlanks) {
  EXPECT_THAT(mc::split("a, b,,c ", ','), testing::ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(mc::split("0:1:.1", ':'), testing::ElementsAre("0", "1", ".1"));
  EXPECT_THAT(mc::split("", ','), testing::ElementsAre(""));
  EXPECT_THAT(mc::split("  ", ','), testing::ElementsAre(""));
  EXPECT_THAT(mc::split("a,", ','), testing::ElementsAre("a", ""));
  EXPECT_THAT(mc::split("\ta b\r\n,\nc", ','), testing::ElementsAre("a b", "c"));
}

TEST(Text, NearestName) {
  const std::array known{"independent", "stratified", "sobol"};
  EXPECT_EQ(mc::did_you_mean("sobal", known), "; did you mean 'sobol'?");
  EXPECT_EQ(mc::did_you_mean("xyzzyxyzzyxyzzy", known), "");
  EXPECT_EQ(mc::did_you_mean("Sobol_", known), "; did you mean 'sobol'?");
  const std::array plugins{"mask", "point", "path"};
  for (const char* other : {"hair", "spot", "volpath", "x"}) EXPECT_EQ(mc::did_you_mean(other, plugins), "") << other;
}

TEST(Text, IndexOf_UnknownName_ListsTheKnownOnes) {
  const std::array<std::string_view, 3> known{"independent", "stratified", "sobol"};
  EXPECT_EQ(mc::index_of("sampler", "independent", known), 0u);
  EXPECT_EQ(mc::index_of("sampler", "sobol", known), 2u);
  try {
    mc::index_of("sampler", "sobal", known);
    FAIL() << "found";
  } catch (const mc::Error& e) {
    EXPECT_STREQ(e.what(), "unknown sampler 'sobal'; did you mean 'sobol'?; use one of independent, stratified, sobol");
  }
}

TEST(Text, EditDistance) {
  EXPECT_EQ(mc::edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(mc::edit_distance("", "abc"), 3u);
  EXPECT_EQ(mc::edit_distance("mes", "mse"), 1u);
  EXPECT_EQ(mc::edit_distance("ab", "ba"), 1u);
  EXPECT_EQ(mc::edit_distance("ca", "abc"), 3u) << "a swapped pair is not edited again";
}

// Checks that the edit distance is symmetric, 0 only for equal words, and at most the number of edits between the
// words.
TEST(Text, EditDistanceIsAMetric) {
  mc::Pcg random(7);
  const auto letter = [&] { return static_cast<char>('a' + random.uniform<double>() * 3); };
  const auto place = [&](std::size_t n) { return static_cast<std::ptrdiff_t>(random.uniform<double>() * double(n)); };
  for (int trial = 0; trial < 300; ++trial) {
    std::string a;
    for (int i = 0; i < trial % 9; ++i) a += letter();
    std::string b = a;
    const std::size_t edits = static_cast<std::size_t>(trial % 4);
    for (std::size_t i = 0; i < edits; ++i) b.insert(b.begin() + place(b.size() + 1), letter());
    const std::size_t d = mc::edit_distance(a, b);
    EXPECT_EQ(d, edits) << a << " " << b; // insertions only, so the lengths differ by their number
    EXPECT_EQ(d, mc::edit_distance(b, a));
    std::string c = b;
    if (!c.empty()) c[static_cast<std::size_t>(place(c.size()))] = letter();
    EXPECT_EQ(mc::edit_distance(b, c), c == b ? 0u : 1u);
    EXPECT_LE(mc::edit_distance(a, c), d + 1);
  }
}

TEST(Text, PrintableIsOneLineThatNoTerminalObeys) {
  EXPECT_EQ(mc::printable(""), "");
  EXPECT_EQ(mc::printable("a b~ \xc3\xa9 \xe2\x89\xa5 \xf0\x9f\x98\x80"),
            "a b~ \xc3\xa9 \xe2\x89\xa5 \xf0\x9f\x98\x80");
  EXPECT_EQ(mc::printable("v\n\x1b[1m\x7f\t"), "v??[1m??");
  EXPECT_EQ(mc::printable("\xff \xc3 \xe2\x89 \xc0\xaf \xed\xa0\x80 \xf5\x80\x80\x80"), "? ? ?? ?? ??? ????")
      << "no UTF-8";
  EXPECT_EQ(mc::printable("\xc2\x9b"
                          "31m"),
            "??31m")
      << "the control character CSI";
  EXPECT_EQ(mc::printable("\xe2\x80\xae"), "???") << "right to left";
  EXPECT_EQ(mc::printable("0123456789", 10), "0123456789");
  EXPECT_EQ(mc::printable("0123456789a", 10), "01234 ... 6789a");
}

} // namespace
