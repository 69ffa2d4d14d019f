#include <render/io/mitsuba/parameter.h>

#include "support/files.h"

namespace {

using namespace render::mitsuba;
using render::Dialect;

struct ParameterTest : support::ScratchTest {
  template <class T>
  T read(const Parameter<T>& p, const std::string& children, Dialect dialect = Dialect::mitsuba) const {
    const auto root = render::read_xml(write("p.xml", "<bsdf>\n" + children + "</bsdf>"));
    Context context(root, dialect, render::Vec3d::Zero());
    return p.read(root, context);
  }
};

TEST_F(ParameterTest, IsWhatTheElementSays) {
  EXPECT_EQ(read(number("a", "", "x"), "<float name=\"a\" value=\"2\"/>"), 2);
  EXPECT_EQ(read(number("a", "", "x"), "<integer name=\"a\" value=\"2\"/>"), 2);
  EXPECT_EQ(read(choice("a", {"p", "q"}, "x"), "<string name=\"a\" value=\"q\"/>"), 1u);
  EXPECT_EQ(read(file("a", "x"), "<string name=\"a\" value=\"m.obj\"/>"), path("m.obj"));
  EXPECT_EQ(read(optional(number("a", "", "x")), "<float name=\"a\" value=\"2\"/>"), std::optional(2.0));
}

TEST_F(ParameterTest, FallbacksFollowTheDialect) {
  const auto p = number("a", "", 3, "x").with_lajolla_default(4, "4");
  EXPECT_EQ(read(p, ""), 3);
  EXPECT_EQ(read(p, "", Dialect::lajolla), 4);
  EXPECT_EQ(read(p, "<float name=\"a\" value=\"2\"/>", Dialect::lajolla), 2);
  EXPECT_EQ(read(optional(number("a", "", "x")), ""), std::nullopt);
  EXPECT_THAT(support::error_of([&] { read(number("a", "", "how much"), ""); }),
              testing::HasSubstr("p.xml:1: <bsdf>: parameter 'a' is missing: how much"));
}

TEST_F(ParameterTest, OnceAndInItsOwnKindOfElement) {
  EXPECT_THAT(support::error_of([&] {
                read(number("a", "", "x"), "<float name=\"a\" value=\"1\"/>\n<float name=\"a\" value=\"1\"/>");
              }),
              testing::HasSubstr("p.xml:3: <float>: a second a, after line 2"));
  EXPECT_THAT(support::error_of([&] { read(number("a", "", "x"), "<string name=\"a\" value=\"1\"/>"); }),
              testing::HasSubstr("p.xml:2: <string>: 'a' must be a <float> or <integer>"));
  EXPECT_THAT(support::error_of([&] {
                read(choice("a", {"smaller", "larger"}, "x"), "<string name=\"a\" value=\"smalle\"/>");
              }),
              testing::HasSubstr("'smalle' is not known; did you mean 'smaller'?; use one of smaller, larger"));
}

} // namespace
