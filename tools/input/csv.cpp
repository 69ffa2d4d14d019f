#include <input/csv.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace carlo {

namespace {

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(" \t\r"), text.size())); }

// One number off the front. What stands there instead, as far as the next separator, when it is none.
double take_number(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find_first_of(",; \t\r"));
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
  mc::require(!word.empty(), "an empty field");
  mc::require(end == word.data() + word.size() && error != std::errc::invalid_argument, "'{}' is not a number",
              word.substr(0, 40));
  mc::require(error == std::errc() && std::isfinite(value), "'{}' is not a finite number", word.substr(0, 40));
  text.remove_prefix(word.size());
  return value;
}

// The names of columns; nan and inf are numbers, though not of ours.
bool is_header(std::string_view text) {
  const std::string_view word = text.substr(0, text.find_first_of(",; \t\r"));
  double value = 0;
  const char* last = word.data() + word.size();
  return (std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '_' || text[0] == '"') &&
         std::from_chars(word.data(), last, value).ptr != last;
}

void parse_row(std::string_view text, CsvTable& table) {
  for (bool more = true; more;) {
    table.values.push_back(take_number(text));
    skip_blanks(text);
    more = !text.empty();
    if (text.starts_with(',') || text.starts_with(';')) {
      text.remove_prefix(1);
      skip_blanks(text);
    }
  }
}

} // namespace

CsvTable read_csv(const std::string& file) {
  const std::string bytes = mc::read_file(file);
  CsvTable table;
  std::uint32_t line = 0;
  bool first = true;
  for (std::string_view rest = bytes; !rest.empty();) {
    std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    ++line;
    if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    skip_blanks(text);
    if (text.empty() || text.starts_with('#')) continue;
    if (std::exchange(first, false) && is_header(text)) continue;
    const std::size_t before = table.values.size();
    mc::with_context(fmt::format("{}:{}", file, line), [&] {
      parse_row(text, table);
      const std::size_t found = table.values.size() - before;
      if (table.lines.empty()) table.columns = found;
      mc::require(found == table.columns, "{} numbers; the rows before have {}", found, table.columns);
    });
    table.lines.push_back(line);
  }
  mc::require(!table.lines.empty(), "{}: it holds no numbers", file);
  return table;
}

} // namespace carlo
