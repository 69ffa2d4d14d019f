#include <report/page_template.h>

#include <gtest/gtest.h>

namespace {

TEST(PageTemplate, MarksInTexts_StayAsTheyAre) {
  EXPECT_EQ(carlo::filled("<@A@><@B@><@A@>", {{"@A@", "x@B@"}, {"@B@", "@A@"}}), "<x@B@><@A@><x@B@>");
  EXPECT_EQ(carlo::filled("no mark", {{"@A@", "x"}}), "no mark");
  EXPECT_EQ(carlo::filled("", {}), "");
}

TEST(PageTemplate, ScriptEndsAreEscaped) { EXPECT_EQ(carlo::script_safe("\"</script>\""), "\"\\u003c/script>\""); }

} // namespace
