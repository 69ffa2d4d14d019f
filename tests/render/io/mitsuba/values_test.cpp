#include <render/io/mitsuba/values.h>

#include "support/files.h"

namespace {

using namespace render::mitsuba;
using testing::HasSubstr;

struct Values : support::ScratchTest {
  render::XmlElement element(const std::string& text) const { return render::read_xml(write("v.xml", text)); }
  template <class F> std::string refusal(const std::string& text, const F& value_of) const {
    return support::error_of([&] { value_of(element(text)); });
  }
};

const auto color_of_element = [](const render::XmlElement& e) { return color_of(e); };

TEST_F(Values, Scalars) {
  EXPECT_EQ(number_of(element("<float value=\" 1.5e2 \"/>")), 150);
  EXPECT_EQ(integer_of(element("<integer value=\"-3\"/>")), -3);
  EXPECT_TRUE(boolean_of(element("<boolean value=\"true\"/>")));
  EXPECT_THAT(refusal("<boolean value=\"yes\"/>", boolean_of),
              HasSubstr("v.xml:1: <boolean>: 'yes' is neither true nor false"));
  EXPECT_THAT(refusal("<float/>", number_of), HasSubstr("attribute 'value' is missing"));
}

TEST_F(Values, BadNumbers) {
  for (const std::string bad : {"abc", "1.5x", "", "nan", "inf", "1e999", "0x10"})
    EXPECT_THAT(refusal("<float value=\"" + bad + "\"/>", number_of), HasSubstr("is not a finite number")) << bad;
  for (const std::string bad : {"1.5", "1e10", "-1e10"})
    EXPECT_THAT(refusal("<integer value=\"" + bad + "\"/>", integer_of), HasSubstr("is not an integer")) << bad;
}

TEST_F(Values, Vectors) {
  EXPECT_EQ(vector_of(element("<point x=\"1\" z=\"3\"/>")), render::Vec3d(1, 0, 3));
  EXPECT_EQ(vector_of(element("<point value=\" 1, 2,3 \"/>")), render::Vec3d(1, 2, 3));
  EXPECT_EQ(vector_of(element("<point value=\".5\"/>")), render::Vec3d(.5, .5, .5));
  EXPECT_THAT(refusal("<point value=\"1 2\"/>", vector_of), HasSubstr("has 2 numbers; give 1 or 3"));
}

TEST_F(Values, Colors) {
  EXPECT_FLOAT_EQ(static_cast<float>(color_of(element("<rgb value=\"0.1, 0.2 0.3\"/>"))[1]), 0.2f);
  EXPECT_FLOAT_EQ(static_cast<float>(color_of(element("<rgb value=\"0.5\"/>"))[2]), 0.5f);
  EXPECT_FLOAT_EQ(static_cast<float>(color_of(element("<srgb value=\"#ff0080\"/>"))[0]), 1);
  EXPECT_NEAR(color_of(element("<srgb value=\"#ff0080\"/>"))[2], 0.21586, 1e-5);
  EXPECT_NEAR(color_of(element("<rgb value=\"#ff0080\"/>"))[2], 128 / 255.0, 1e-6);
  EXPECT_NEAR(color_of(element("<srgb value=\"0.5\"/>"))[0], 0.214041, 1e-6);
  EXPECT_NEAR(color_of(element("<spectrum value=\"400:1, 700:1\"/>"))[0], 1.1993, 1e-4);
  const auto spectrum = [&](const std::string& pairs) {
    return color_of(element("<spectrum value=\"" + pairs + "\"/>"));
  };
  const render::Spectrum color = spectrum("400:0.1, 500:0.3, 700:0.2");
  for (const char* pairs : {"400:0.1 500:0.3 700:0.2", " 400:0.1,500:0.3 ,700:0.2,", "400 : 0.1\n500: 0.3\t700 :0.2"})
    EXPECT_TRUE((spectrum(pairs) == color).all()) << pairs;
  EXPECT_THAT(refusal("<spectrum value=\"400:1 500 700:2\"/>", color_of_element),
              HasSubstr("'500' is not wavelength:value"));
  EXPECT_THAT(refusal("<spectrum value=\"400:, 700:2\"/>", color_of_element), HasSubstr("'' is not a finite number"));
  EXPECT_THAT(refusal("<spectrum value=\"400:1, 500:-0.5, 700:2\"/>", color_of_element),
              HasSubstr("v.xml:1: <spectrum>: '-0.5' is below 0 at 500 nm; say 0"));
  for (const std::string unseen : {"0.4:1, 0.7:2", "4e-7:1 7e-7:2", "700.5:1, 800:1", "300:1, 399:1"})
    EXPECT_THAT(refusal("<spectrum value=\"" + unseen + "\"/>", color_of_element),
                HasSubstr("give them in nanometres"));
  EXPECT_GT(color_of(element("<spectrum value=\"300:1, 800:1\"/>"))[0], 1);
  EXPECT_FLOAT_EQ(static_cast<float>(color_of(element("<spectrum value=\"0.25\"/>"))[0]), 0.25f);
  EXPECT_FLOAT_EQ(static_cast<float>(color_of(element("<float value=\"0.75\"/>"))[1]), 0.75f);
  EXPECT_THAT(refusal("<spectrum value=\"400:1, 700\"/>", color_of_element), HasSubstr("is not wavelength:value"));
  EXPECT_THAT(refusal("<rgb value=\"1 2\"/>", color_of_element), HasSubstr("has 2 numbers; give 1 or 3"));
  EXPECT_THAT(refusal("<rgb value=\"#12345\"/>", color_of_element), HasSubstr("is not #rrggbb"));
}

TEST_F(Values, TransformsApplyInOrder) {
  const auto t = transform_of(
      element("<transform><scale x=\"2\"/><rotate z=\"1\" angle=\"90\"/><translate x=\"5\" y=\"1\"/></transform>"));
  EXPECT_NEAR((t.point({1, 0, 0}) - render::Vec3d(5, 3, 0)).norm(), 0, 1e-12); // (2,0,0) -> (0,2,0) -> (5,3,0)
  const auto m =
      transform_of(element("<transform><matrix value=\" 1 2 3 4\n 5 6 7 8\n 9 10 11 12\n 0 0 0 1 \"/></transform>"));
  EXPECT_EQ(m.point({1, 0, 0}), render::Vec3d(5, 13, 21));
}

TEST_F(Values, LookAtIsMitsubasFrame) {
  for (const std::string tag : {"lookAt", "lookat"}) {
    const auto t = transform_of(
        element("<transform><" + tag + " origin=\"0, 0, -5\" target=\"0,0,0\" up=\"0 1 0\"/></transform>"));
    EXPECT_NEAR((t.vector({0, 0, 1}) - render::Vec3d(0, 0, 1)).norm(), 0, 1e-12) << "forward";
    EXPECT_NEAR((t.vector({1, 0, 0}) - render::Vec3d(1, 0, 0)).norm(), 0, 1e-12) << "left";
    EXPECT_NEAR((t.translation - render::Vec3d(0, 0, -5)).norm(), 0, 1e-12);
  }
}

TEST_F(Values, BadTransformsNameTheirLine) {
  const auto said = [&](const std::string& step) {
    return refusal("<transform>\n" + step + "</transform>", transform_of);
  };
  EXPECT_THAT(said("<lookAt origin=\"0 0 0\" target=\"0 1 0\" up=\"0 1 0\"/>"),
              HasSubstr("v.xml:2: lookAt: target - origin"));
  EXPECT_THAT(said("<rotate angle=\"3\"/>"), HasSubstr("v.xml:2: rotate: the axis must not be 0"));
  EXPECT_THAT(said("<matrix value=\"1 2 3\"/>"), HasSubstr("has 3 numbers; 16 are needed"));
  EXPECT_THAT(said("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>"), HasSubstr("last row"));
  EXPECT_THAT(said("<shear x=\"1\"/>"), HasSubstr("unknown transformation"));
}

} // namespace
