#include <render/io/mitsuba/variables.h>

#include "support/files.h"

#include <fmt/format.h>

namespace {

struct Variables : support::ScratchTest {
  render::XmlElement element(const std::string& body, const render::Variables& given = {}) const {
    auto root = render::read_xml(write("v.xml", "<scene>\n" + body + "\n</scene>"));
    render::mitsuba::substitute_variables(root, given);
    return root;
  }
};

TEST_F(Variables, StandForTheirValues) {
  const auto root = element("<default name=\"a\" value=\"1\"/><default name=\"ab\" value=\"$a, 2\"/>"
                            "<default name=\"a\" value=\"9\"/><x v=\"$a\" w=\"[$ab.$a]\"><y v=\"$ab\"/></x>");
  const auto& x = root.children.back();
  EXPECT_EQ(x.attribute("v"), "1") << "the first default counts";
  EXPECT_EQ(x.attribute("w"), "[1, 2.1]") << "the longest name that fits";
  EXPECT_EQ(x.children[0].attribute("v"), "1, 2");
}

TEST_F(Variables, GivenOnesGoBeforeDefaults) {
  const auto root = element("<default name=\"a\" value=\"1\"/><x v=\"$a\" w=\"$b\"/>", {{"a", "2"}, {"b", "3"}});
  EXPECT_EQ(root.children.back().attribute("v"), "2");
  EXPECT_EQ(root.children.back().attribute("w"), "3");
  EXPECT_NO_THROW(element("<default name=\"a\" value=\"1\"/>", {{"a", "2"}})) << "its default would not be used either";
  EXPECT_THAT(support::error_of([&] {
                element("<x v=\"$a\"/>", {{"a", "2"}, {"c", "4"}});
              }),
              testing::HasSubstr("v.xml: the scene has no $c that could be 4"));
}

TEST_F(Variables, UnknownOnesAreNamed) {
  EXPECT_THAT(support::error_of([&] { element("<default name=\"spp\" value=\"4\"/>\n<x v=\"$ssp\"/>"); }),
              testing::HasSubstr("v.xml:3: <x>: no <default> above defines $ssp; did you mean 'spp'?, nor is it given "
                                 "(carlo render -D NAME=VALUE)"));
  // A default is valid from its place on, so definitions cannot be circular.
  EXPECT_THAT(
      support::error_of([&] { element("<default name=\"a\" value=\"$b\"/>\n<default name=\"b\" value=\"$a\"/>"); }),
      testing::HasSubstr("v.xml:2: <default>: no <default> above defines $b"));
  EXPECT_THAT(support::error_of([&] { element("<default name=\"\" value=\"4\"/>"); }),
              testing::HasSubstr("must not be empty"));
  EXPECT_THAT(support::error_of([&] { element("<x v=\"$\"/>"); }), testing::HasSubstr("defines $"));
}

TEST_F(Variables, DoNotGrowWithoutBound) {
  std::string doubling = "<default name=\"a0\" value=\"0123456789\"/>\n";
  for (int i = 1; i < 40; ++i) doubling += fmt::format("<default name=\"a{}\" value=\"$a{}$a{}\"/>\n", i, i - 1, i - 1);
  EXPECT_THAT(support::error_of([&] { element(doubling); }),
              testing::HasSubstr("v.xml:19: <default>: with its variables a value is longer than 1048576 characters"));
}

} // namespace
