#include <report/html.h>
#include <validate_page_parts.h>

#include <fmt/format.h>

namespace carlo {

std::string escape_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') safe += "&lt;";
    else if (c == '>') safe += "&gt;";
    else if (c == '&') safe += "&amp;";
    else if (c == '"') safe += "&quot;";
    else safe += c;
  }
  return safe;
}

void HtmlTable::add(const std::vector<std::string>& cells) {
  rows_ += "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    rows_ += fmt::format("<td data-label=\"{}\"{}>{}</td>", escape_html(columns_[i]),
                         cells[i] == "-" ? " class=\"dash\"" : "", cells[i]);
  rows_ += "</tr>";
}

void HtmlTable::add_note(const std::string& first, const std::string& note) {
  rows_ += fmt::format("<tr><td data-label=\"{}\">{}</td><td class=\"none\" colspan=\"{}\">{}</td></tr>",
                       escape_html(columns_.front()), first, columns_.size() - 1, note);
}

std::string HtmlTable::html(Width width) const {
  std::string s =
      fmt::format("<div class=\"scroll\"><table class=\"data{}\"><thead><tr>", width == Width::wide ? " cards" : "");
  for (const std::string& column : columns_) s += fmt::format("<th>{}</th>", escape_html(column));
  return s + "</tr></thead><tbody>" + rows_ + "</tbody></table></div>";
}

std::string to_html(const HtmlPage& page) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{0}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{1}{2}</style>\n</head>\n<body>\n<header>\n"
      "<p class=\"tool\">{0}</p>\n<h1>{3}</h1>\n{4}<p class=\"command\"><code>{5}</code></p>\n</header>\n<main>\n{6}"
      "</main>\n<footer><p>{7}</p></footer>\n</body>\n</html>\n",
      page.tool, page_css, page.style, page.title, page.note, escape_html(page.command), page.main, page.footer);
}

} // namespace carlo
