#pragma once
/// Lines of text files with a keyword each: OBJ and MTL.

#include <algorithm>
#include <string>
#include <string_view>

namespace render {

/// Removes and returns the first word of `rest`; empty at the end.
inline std::string_view next_word(std::string_view& rest) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const auto begin = std::find_if_not(rest.begin(), rest.end(), is_blank);
  const auto end = std::find_if(begin, rest.end(), is_blank);
  rest = {end, rest.end()};
  return {begin, end};
}

/// The words that remain, without blanks around them: a name that may contain blanks.
inline std::string_view rest_of_line(std::string_view rest) {
  const std::size_t begin = rest.find_first_not_of(" \t");
  if (begin == rest.npos) return {};
  return rest.substr(begin, rest.find_last_not_of(" \t") + 1 - begin);
}

/// Calls f(line number, keyword, rest of the line) for every line; # begins a comment.
template <class F> void for_each_line(std::string_view text, const F& f) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = next_word(line);
    f(number, keyword, line);
  }
}

/// The text with a line feed at every end of a line.
inline std::string with_plain_ends(std::string text) {
  for (std::size_t i = text.find('\r'); i != text.npos; i = text.find('\r', i + 1))
    text[i] = text.compare(i, 2, "\r\n") == 0 ? ' ' : '\n';
  return text;
}

} // namespace render
