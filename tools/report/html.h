#pragma once
/// Building blocks of HTML pages.

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Returns the text with HTML special characters escaped, also for attributes.
std::string escape_html(std::string_view text);

/// A table with text as its head and HTML as its cells. On narrow screens each row is a card that names the column of
/// each cell. Columns are aligned to the right, except the first. A cell "-" has no value, so cards omit it.
class HtmlTable {
 public:
  enum class Width { narrow, wide }; ///< narrow: it fits a phone as it is

  explicit HtmlTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void add(const std::vector<std::string>& cells);
  /// A row of one wide cell below the first.
  void add_note(const std::string& first, const std::string& note);
  bool is_empty() const { return rows_.empty(); }
  std::string html(Width width = Width::wide) const;

 private:
  std::vector<std::string> columns_;
  std::string rows_;
};

/// A page in the style that all pages of carlo share. All members but `command` are HTML. The page needs no script and
/// no network.
struct HtmlPage {
  std::string_view tool;  ///< "carlo gallery"
  std::string_view title; ///< what the page is about
  std::string_view style; ///< additional CSS
  std::string note{};     ///< below the title
  std::string command{};  ///< the command that wrote the page
  std::string main{}, footer{};
};
std::string to_html(const HtmlPage& page);

} // namespace carlo
