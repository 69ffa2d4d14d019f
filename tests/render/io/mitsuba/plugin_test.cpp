#include <render/io/mitsuba/plugin.h>

#include "support/files.h"

namespace {

using namespace render::mitsuba;
using testing::HasSubstr;

int make_sum(int a, int b) {
  mc::require(a + b >= 0, "the sum {} must be >= 0", a + b);
  return a + b;
}

const Plugins<int>& rows() {
  static const Plugins<int> table = {
      plugin<int>("sum", "adds", make_sum, integer("a", "first", 1), integer("b", "second", 2))
          .accepting({no_effect("c", "as I like it"), only(false, "d", "no")}),
      plugin<int>("one", "is 1", [] { return 1; }),
      plugin<int>("two", "its parameters", make_sum, integer("intIOR", "first", 1), integer("uScale0", "second", 1)),
  };
  return table;
}

struct PluginTest : support::ScratchTest {
  int read(const std::string& text) const {
    const auto root = render::read_xml(write("p.xml", text));
    Context context(root, render::Dialect::mitsuba, render::Vec3d::Zero());
    const int value = read_plugin(rows(), root, context);
    root.require_all_used();
    return value;
  }
  std::string refusal(const std::string& text) const {
    return support::error_of([&] { read(text); });
  }
};

TEST_F(PluginTest, IsMadeOfItsParametersInOrder) {
  EXPECT_EQ(read("<x type=\"one\"/>"), 1);
  EXPECT_EQ(read("<x type=\"sum\"/>"), 3);
  EXPECT_EQ(read("<x type=\"sum\"><integer name=\"b\" value=\"-1\"/><float name=\"c\" value=\"?\"/>"
                 "<boolean name=\"d\" value=\"false\"/></x>"),
            0);
}

TEST_F(PluginTest, NamesAreSpelledInEitherWay) {
  EXPECT_EQ(read("<x type=\"two\"><integer name=\"int_ior\" value=\"3\"/></x>"), 4);
  EXPECT_EQ(read("<x type=\"two\"><integer name=\"intIOR\" value=\"3\"/><integer name=\"u_scale0\" value=\"5\"/></x>"),
            8);
  EXPECT_THAT(
      refusal("<x type=\"two\"><integer name=\"intIOR\" value=\"3\"/><integer name=\"int_ior\" value=\"3\"/></x>"),
      HasSubstr("a second intIOR"));
  for (const char* wrong : {"int_IOR", "int_IR", "intior", "int_ior_", "_int_ior"})
    EXPECT_THAT(refusal(std::string("<x type=\"two\"><integer name=\"") + wrong + "\" value=\"3\"/></x>"),
                HasSubstr("did you mean 'intIOR'?"));
}

TEST_F(PluginTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal("<x type=\"sun\"/>"),
              HasSubstr("p.xml:1: <x>: unknown type 'sun'; did you mean 'sum'?; use one of sum, one, two"));
  EXPECT_THAT(refusal("<x type=\"one\">\n<float name=\"a\" value=\"1\"/></x>"),
              HasSubstr("p.xml:2: <float>: one has no 'a'; it has no parameters: remove it"));
  EXPECT_THAT(refusal("<x type=\"sum\">\n<float name=\"bb\" value=\"1\"/></x>"),
              HasSubstr("sum has no 'bb'; did you mean 'b'?; its parameters are a, b, c, d"));
  EXPECT_THAT(refusal("<x type=\"sum\">\n<boolean name=\"d\" value=\"true\"/></x>"),
              HasSubstr("p.xml:2: <boolean>: d = true is not supported (no); remove it"));
  EXPECT_THAT(refusal("<x type=\"sum\"><integer name=\"a\" value=\"-9\"/></x>"),
              HasSubstr("p.xml:1: <x>: the sum -7 must be >= 0"));
  EXPECT_THAT(refusal("<x type=\"sum\" odd=\"1\"/>"), HasSubstr("attribute odd=\"1\" is not supported"));
}

} // namespace
