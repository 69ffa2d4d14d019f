#include <report/page_template.h>

namespace carlo {

std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& marks) {
  std::string page;
  while (true) {
    std::size_t next = std::string_view::npos;
    const std::pair<std::string_view, std::string>* first = nullptr;
    for (const auto& mark : marks)
      if (const std::size_t at = text.find(mark.first); at < next) {
        next = at;
        first = &mark;
      }
    page += text.substr(0, next);
    if (!first) return page;
    page += first->second;
    text.remove_prefix(next + first->first.size());
  }
}

std::string script_safe(std::string_view json) {
  std::string safe;
  for (const char c : json) {
    if (c == '<') safe += "\\u003c";
    else safe += c;
  }
  return safe;
}

} // namespace carlo
