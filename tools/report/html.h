#pragma once
/// Text in pages, and pages of it.

#include <string>
#include <string_view>

namespace carlo {

/// A text as HTML that shows it, in an attribute too.
std::string escape_html(std::string_view text);

/// A page in the looks of all of carlo's, of HTML but for the command. It needs no script and no network.
struct HtmlPage {
  std::string_view tool;  ///< "carlo gallery"
  std::string_view title; ///< what the page is about
  std::string_view style; ///< CSS of its own
  std::string note{};     ///< below the title
  std::string command{};  ///< that made it
  std::string main{}, footer{};
};
std::string to_html(const HtmlPage& page);

} // namespace carlo
