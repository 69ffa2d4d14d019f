#include <terminal/columns.h>

#include <mc/core/text.h>

#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace carlo {

std::size_t terminal_columns(int descriptor) {
  constexpr double least = 20, most = 10'000;
  if (const char* variable = std::getenv("COLUMNS")) { // NOLINT(concurrency-mt-unsafe): nothing sets the environment
    const double columns = mc::parse_double(variable).value_or(0);
    if (columns >= least && columns <= most && columns == std::floor(columns)) return static_cast<std::size_t>(columns);
  }
  winsize window{};
  if (ioctl(descriptor, TIOCGWINSZ, &window) == 0 && window.ws_col >= least) return window.ws_col;
  return 80;
}

std::size_t columns_of(std::string_view text) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins));
}

std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent, std::size_t used) {
  std::string all;
  std::string line(indent - std::min(used, indent), ' ');
  std::size_t width = indent;
  bool is_empty = true; // no word in the line yet
  const auto end_line = [&] {
    all += (is_empty ? "" : line) + "\n";
    line.assign(indent, ' ');
    width = indent;
    is_empty = true;
  };
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find_first_of(" \n"), text.size());
    const std::string_view word = text.substr(0, blank);
    const std::size_t length = columns_of(word);
    if (!word.empty()) {
      if (!is_empty && width + 1 + length > columns) end_line();
      if (!is_empty) line += ' ';
      line += word;
      width += length + (is_empty ? 0 : 1);
      is_empty = false;
    }
    if (blank < text.size() && text[blank] == '\n') end_line();
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  if (!is_empty) end_line();
  return all;
}

std::string term_row(std::string_view term, std::string_view text, std::size_t columns, std::size_t indent,
                     std::size_t hang) {
  std::string row(indent, ' ');
  row += term;
  const std::size_t used = indent + columns_of(term);
  if (text.empty()) return row + "\n";
  if (used + 2 <= hang) return row + wrapped(text, columns, hang, used);
  return row + "\n" + wrapped(text, columns, hang);
}

} // namespace carlo
