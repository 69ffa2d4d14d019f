#include <render/io/xml_values.h>

#include "support/files.h"

namespace {

struct XmlValues : support::ScratchTest {
  render::XmlElement element;
  render::Parameters parse(const std::string& body) {
    element = render::read_xml(write("v.xml", "<p>" + body + "</p>"));
    return render::Parameters(element);
  }
};

TEST_F(XmlValues, Scalars) {
  const auto p = parse("<float name=\"a\" value=\" 1.5e2 \"/><integer name=\"b\" value=\"-3\"/><boolean name=\"c\" "
                       "value=\"true\"/><string name=\"d\" value=\"x y\"/>");
  EXPECT_EQ(p.number("a"), 150);
  EXPECT_EQ(p.integer("b"), -3);
  EXPECT_TRUE(p.boolean("c", false));
  EXPECT_EQ(p.string("d"), "x y");
  EXPECT_EQ(p.number("none", 7.0), 7);
  EXPECT_THAT(support::error_of([&] { p.number("none"); }), testing::HasSubstr("parameter 'none' is missing"));
  EXPECT_THAT(support::error_of([&] { p.number("c"); }), testing::HasSubstr("'c' must be a <float> or <integer>"));
}

TEST_F(XmlValues, BadNumbers) {
  for (const char* bad : {"abc", "1.5x", "", "nan", "inf", "1e999"}) {
    const auto p = parse(std::string("<float name=\"a\" value=\"") + bad + "\"/>");
    EXPECT_THAT(support::error_of([&] { p.number("a"); }), testing::HasSubstr("is not a finite number")) << bad;
  }
  const auto p = parse("<integer name=\"a\" value=\"1.5\"/>");
  EXPECT_THAT(support::error_of([&] { p.integer("a"); }), testing::HasSubstr("'1.5' is not an integer"));
}

TEST_F(XmlValues, Colors) {
  const auto p = parse(
      "<rgb name=\"a\" value=\"0.1, 0.2 0.3\"/><rgb name=\"b\" value=\"0.5\"/><srgb name=\"c\" value=\"#ff0080\"/>"
      "<spectrum name=\"d\" value=\"400:1, 700:1\"/><spectrum name=\"e\" value=\"400:1, 700\"/><rgb name=\"f\" "
      "value=\"1 2\"/>");
  EXPECT_FLOAT_EQ(static_cast<float>(p.color("a")[1]), 0.2f);
  EXPECT_FLOAT_EQ(static_cast<float>(p.color("b")[2]), 0.5f);
  EXPECT_FLOAT_EQ(static_cast<float>(p.color("c")[0]), 1);
  EXPECT_NEAR(p.color("c")[2], 0.21586, 1e-5);
  EXPECT_NEAR(p.color("d")[0], 1.1993, 1e-4);
  EXPECT_THAT(support::error_of([&] { p.color("e"); }), testing::HasSubstr("is not wavelength:value"));
  EXPECT_THAT(support::error_of([&] { p.color("f"); }), testing::HasSubstr("has 2 numbers; 3 are needed"));
}

TEST_F(XmlValues, TransformsApplyInOrder) {
  const auto p = parse(
      "<transform name=\"t\"><scale x=\"2\"/><rotate z=\"1\" angle=\"90\"/><translate x=\"5\" y=\"1\"/></transform>");
  const render::Transform t = p.transform("t");
  const render::Vec3d q = t.point({1, 0, 0}); // (2,0,0) -> (0,2,0) -> (5,3,0)
  EXPECT_NEAR((q - render::Vec3d(5, 3, 0)).norm(), 0, 1e-12);
}

TEST_F(XmlValues, LookAtIsMitsubasFrame) {
  const auto p = parse("<transform name=\"t\"><lookAt origin=\"0, 0, -5\" target=\"0,0,0\" up=\"0 1 0\"/></transform>");
  const render::Transform t = p.transform("t");
  EXPECT_NEAR((t.linear.col(2) - render::Vec3d(0, 0, 1)).norm(), 0, 1e-12) << "forward";
  EXPECT_NEAR((t.linear.col(0) - render::Vec3d(1, 0, 0)).norm(), 0, 1e-12) << "left";
  EXPECT_NEAR((t.translation - render::Vec3d(0, 0, -5)).norm(), 0, 1e-12);
  const auto bad = parse("<transform name=\"t\"><lookAt origin=\"0 0 0\" target=\"0 1 0\" up=\"0 1 0\"/></transform>");
  EXPECT_THAT(support::error_of([&] { bad.transform("t"); }), testing::HasSubstr("parallel to up"));
}

} // namespace
