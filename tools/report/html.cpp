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
