#include <report/html.h>

#include <gtest/gtest.h>

namespace {

TEST(Html, ShowsWhatMeansSomethingInHtml) {
  EXPECT_EQ(carlo::escaped("a < b > \"c\" & d"), "a &lt; b &gt; &quot;c&quot; &amp; d");
  EXPECT_EQ(carlo::escaped(""), "");
}

} // namespace
