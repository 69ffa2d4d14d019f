#include <report/html.h>

#include <gtest/gtest.h>

namespace {

TEST(Html, EscapesSpecialCharacters) {
  EXPECT_EQ(carlo::escape_html("a < b > \"c\" & d"), "a &lt; b &gt; &quot;c&quot; &amp; d");
  EXPECT_EQ(carlo::escape_html(""), "");
}

} // namespace
