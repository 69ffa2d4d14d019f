#include <input/words.h>
#include <integrands/sides.h>

namespace carlo {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> words;
  for (bool more = true; more;) {
    const std::size_t end = text.find(separator);
    words.push_back(trimmed(text.substr(0, end)));
    more = end != std::string_view::npos;
    if (more) text.remove_prefix(end + 1);
  }
  return words;
}

} // namespace carlo
