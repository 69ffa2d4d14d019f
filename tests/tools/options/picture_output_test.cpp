#include <options/picture_output.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using support::error_of;
using testing::HasSubstr;

TEST(ParseTone, ReplacesOnlyThePartsThatAreGiven) {
  const render::ToneMapping start{render::ToneCurve::filmic, 2};
  EXPECT_EQ(carlo::parse_tone("", "", start).curve, render::ToneCurve::filmic);
  EXPECT_EQ(carlo::parse_tone("", "", start).exposure, 2);
  EXPECT_EQ(carlo::parse_tone("reinhard", "auto", start).curve, render::ToneCurve::reinhard);
  EXPECT_EQ(carlo::parse_tone("reinhard", "auto", start).exposure, 2);
  EXPECT_EQ(carlo::parse_tone("", "-1.5").exposure, -1.5);
}

TEST(ParseTone, RefusesOtherWords) {
  EXPECT_THAT(error_of([] { carlo::parse_tone("filmc", ""); }), HasSubstr("did you mean 'filmic'?"));
  for (const char* text : {"bright", "1 stop", "101", "-100.5", "nan", "inf"})
    EXPECT_EQ(error_of([&] { carlo::parse_tone("", text); }),
              std::string("--exposure '") + text + "' must be a number of stops in [-100, 100], or auto");
}

struct PictureOutput : support::ScratchTest {};

TEST_F(PictureOutput, RefusesFormatsAndFoldersBeforeTheWork) {
  for (const char* name : {"a.exr", "a.PFM", "a.png"})
    EXPECT_EQ(error_of([&] { carlo::require_picture_output(path(name)); }), "");
  EXPECT_THAT(error_of([&] { carlo::require_picture_output(path("a.jpg")); }),
              HasSubstr("unknown image format '.jpg'; use .exr, .pfm or .png"));
  EXPECT_THAT(error_of([&] { carlo::require_picture_output(path("none/a.exr")); }), HasSubstr("none"));
}

} // namespace
