#include <documents/manual.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace carlo {

namespace {

// Text as troff prints it: hyphens that can be copied, no commands at the start of a line.
std::string escaped(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else out += c;
    at_start = c == '\n';
  }
  return out;
}

std::string heading(std::string_view title) {
  std::string upper(title);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return fmt::format(".SH {}\n", escaped(upper));
}

std::string entry_text(const HelpEntry& e) {
  if (e.term.empty()) return ".PP\n" + escaped(e.text) + "\n";
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(e.term), escaped(e.text));
}

} // namespace

std::string manual_page(std::string_view name, const HelpPage& page, std::string_view version,
                        const std::vector<std::string>& others) {
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string text = fmt::format(".TH {} 1 \"\" \"libmc {}\" \"User Commands\"\n", escaped(upper), version);
  text += heading("Name") + fmt::format("{} \\- {}\n", escaped(name), escaped(page.summary));
  text += heading("Synopsis") + fmt::format(".B {}\n", escaped(page.usage));
  if (!page.examples.empty()) text += heading("Examples");
  for (const HelpEntry& e : page.examples) text += entry_text(e);
  for (const HelpSection& s : page.sections) {
    if (!s.title.empty()) text += heading(s.title);
    for (const HelpEntry& e : s.entries) text += entry_text(e);
  }
  text += heading("See also");
  for (const std::string& other : others)
    text += fmt::format(".BR {} (1){}\n", escaped(other), &other == &others.back() ? "" : ",");
  return text;
}

} // namespace carlo
