#include <report/html.h>

#include <gtest/gtest.h>

namespace {

TEST(Html, EscapesSpecialCharacters) {
  EXPECT_EQ(carlo::escape_html("a < b > \"c\" & d"), "a &lt; b &gt; &quot;c&quot; &amp; d");
  EXPECT_EQ(carlo::escape_html(""), "");
}

TEST(HtmlTable, NamesTheColumnOfEachCell) {
  carlo::HtmlTable table({"N < 10", "error"});
  EXPECT_TRUE(table.is_empty());
  table.add({"4", "<b>0.1</b>"});
  table.add({"8", "-"});
  table.add_note("9", "too few");
  EXPECT_FALSE(table.is_empty());
  EXPECT_EQ(table.html(), "<div class=\"scroll\"><table class=\"data cards\"><thead><tr><th>N &lt; "
                          "10</th><th>error</th></tr></thead><tbody>"
                          "<tr><td data-label=\"N &lt; 10\">4</td><td data-label=\"error\"><b>0.1</b></td></tr>"
                          "<tr><td data-label=\"N &lt; 10\">8</td><td data-label=\"error\" class=\"dash\">-</td></tr>"
                          "<tr><td data-label=\"N &lt; 10\">9</td><td class=\"none\" colspan=\"1\">too few</td></tr>"
                          "</tbody></table></div>");
}

} // namespace
