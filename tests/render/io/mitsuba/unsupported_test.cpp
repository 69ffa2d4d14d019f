#include <render/io/mitsuba/plugins.h>
#include <render/io/mitsuba/unsupported.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using render::mitsuba::why_unsupported;
using testing::HasSubstr;

TEST(Unsupported, GivesTheReason) {
  EXPECT_THAT(why_unsupported("integrator", "bdpt"), HasSubstr("bidirectional path tracing is not supported"));
  EXPECT_THAT(why_unsupported("emitter", "projector"), HasSubstr("use point"));
  EXPECT_EQ(why_unsupported("emitter", "pont"), "");
  EXPECT_EQ(why_unsupported("shape", "spot"), "");
}

// No supported plugin is listed as unsupported.
TEST(Unsupported, NamesNoPluginThatIsRead) {
  for (const render::mitsuba::Kind& kind : render::mitsuba::all_plugins())
    for (const render::mitsuba::PluginText& plugin : kind.rows)
      EXPECT_EQ(why_unsupported(kind.tag.substr(0, kind.tag.find(' ')), plugin.name), "") << plugin.name;
}

} // namespace
