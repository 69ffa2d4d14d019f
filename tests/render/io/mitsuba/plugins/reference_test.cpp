#include <render/io/mitsuba/plugins.h>
#include <render/io/mitsuba/plugins/reference.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

TEST(Reference, HoldsEveryPluginAndParameter) {
  const std::string text = render::mitsuba::reference();
  for (const auto& kind : render::mitsuba::all_plugins())
    for (const auto& row : kind.rows) {
      EXPECT_THAT(text, testing::HasSubstr("**" + row.name + "**"));
      EXPECT_THAT(text, testing::HasSubstr("**: " + row.meaning + "\n"));
      for (const auto& d : row.parameters) EXPECT_THAT(text, testing::HasSubstr("\n| `" + d.name + "` | "));
    }
  EXPECT_THAT(text, testing::HasSubstr("| `width` | integer |  | 768 (lajolla: 256) | pixels in a row |"));
}

TEST(Reference, IsWhatTheProjectShows) {
  EXPECT_EQ(mc::read_file(std::string(MC_SOURCE_DIR) + "/librender/scenes/REFERENCE.md"), render::mitsuba::reference())
      << "write it again: carlo render --help-scene > librender/scenes/REFERENCE.md";
}

} // namespace
