#include <input/words.h>

#include <algorithm>

namespace carlo {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> words;
  for (bool more = true; more;) {
    const std::size_t end = text.find(separator);
    std::string_view word = text.substr(0, end);
    word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
    word = word.substr(0, word.find_last_not_of(' ') + 1);
    words.push_back(word);
    more = end != std::string_view::npos;
    if (more) text.remove_prefix(end + 1);
  }
  return words;
}

} // namespace carlo
