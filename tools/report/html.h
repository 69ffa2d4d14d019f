#pragma once
/// HTML pages and text in them.

#include <string>
#include <string_view>

namespace carlo {

/// Returns the text with HTML special characters escaped, also for attributes.
std::string escape_html(std::string_view text);

/// A page in the common style of carlo's pages. All members are HTML except `command`, which is escaped. The page needs
/// no script and no network.
struct HtmlPage {
  std::string_view tool;  ///< for example "carlo gallery"
  std::string_view title; ///< heading of the page
  std::string_view style; ///< additional CSS
  std::string note{};     ///< text below the title
  std::string command{};  ///< the command that created the page
  std::string main{}, footer{};
};
/// Returns the page as a complete HTML document.
std::string to_html(const HtmlPage& page);

} // namespace carlo
