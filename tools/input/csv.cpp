#include <input/csv.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace carlo {

namespace {

constexpr std::string_view blanks = " \t\r", ends = ",; \t\r\"";

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size())); }

bool skip(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

// A number and the exponent of 10 of its last digit.
struct Number {
  double value = 0;
  int digit = 0;
  int significant = 0; // number of digits from the first nonzero digit
  bool whole = false;  // the whole word is a number
  bool finite = false;
};

Number parse(std::string_view word) {
  Number n;
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), n.value);
  n.whole = !word.empty() && end == word.data() + word.size() && error != std::errc::invalid_argument;
  const std::optional<double> value = mc::parse_double(word); // 1e-400 is 0
  n.finite = value && std::isfinite(*value);
  if (!n.finite) return n;
  n.value = *value;
  const std::size_t exponent = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, exponent);
  if (const std::size_t point = mantissa.find('.'); point != std::string_view::npos)
    n.digit = -static_cast<int>(mantissa.size() - point - 1);
  bool leads = true;
  for (const char c : mantissa) {
    leads = leads && (c < '1' || c > '9');
    n.significant += !leads && c != '.';
  }
  if (exponent != std::string_view::npos) {
    int power = 0;
    const char* from = word.data() + exponent + 1;
    std::from_chars(from + (*from == '+' ? 1 : 0), word.data() + word.size(), power);
    n.digit += power;
  }
  return n;
}

constexpr const char* unclosed = "a quotation mark without its other";

// Removes the first field and returns it without its quotation marks and the blanks inside them.
std::string_view take_word(std::string_view& text) {
  const bool quoted = skip(text, '"');
  const std::string_view word = text.substr(0, text.find_first_of(quoted ? "\"" : ends));
  text.remove_prefix(word.size());
  mc::require(skip(text, '"') == quoted, unclosed);
  return quoted ? mc::trimmed(word) : word;
}

// For example 0,5 for 0.5. Without quotation marks it would be two numbers.
bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return false;
  std::string pointed(word);
  pointed[comma] = '.';
  return parse(pointed).whole;
}

Number take_number(std::string_view& text) {
  const std::string_view word = take_word(text);
  const Number n = parse(word);
  mc::require(!word.empty(), "an empty field");
  mc::require(!has_decimal_comma(word), "'{}' has a decimal comma; write a decimal point", word.substr(0, 40));
  mc::require(n.whole, "'{}' is not a number", word.substr(0, 40));
  mc::require(n.finite, "'{}' is not a finite number", word.substr(0, 40));
  return n;
}

// A letter or _. In UTF-8, the first byte of a Latin, Greek or Cyrillic letter, but not of a space or a minus sign.
bool begins_name(std::string_view word) {
  if (word.empty()) return false;
  const auto c = static_cast<unsigned char>(word[0]);
  return std::isalpha(c) || c == '_' || (c >= 0xc3 && c <= 0xd4);
}

// Column names. The words nan and inf are numbers, which are rejected later.
bool is_header(std::string_view text) {
  const std::string_view word = take_word(text);
  return begins_name(word) && !parse(word).whole;
}

// The text before the first # outside of quotation marks.
std::string_view without_comment(std::string_view text) {
  if (text.find('#') == std::string_view::npos) return text;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '#' && !quoted) return text.substr(0, i);
  }
  return text;
}

// The print format of a column: largest number of decimals and of significant digits.
struct Precision {
  int decimals = -1000, significant = 0;
};

// Programs omit trailing zeros: 1.5 among 0.123456 is 1.50000, and 12.5 among 12.345 is 12.500. The last digit of each
// value is refined to the precision of its column.
void refine_digits(CsvTable& table, const std::vector<Precision>& columns) {
  table.digits_below = table.digits;
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const Precision& p = columns[i % table.columns];
    const auto refine = [&](std::int16_t& digit, int magnitude) {
      digit = static_cast<std::int16_t>(std::min<int>(digit, std::max(magnitude - p.significant + 1, -p.decimals)));
    };
    const double size = std::abs(table.values[i]), magnitude = size > 0 ? std::floor(std::log10(size)) : -1000;
    refine(table.digits[i], static_cast<int>(magnitude));
    refine(table.digits_below[i], static_cast<int>(size == std::pow(10.0, magnitude) ? magnitude - 1 : magnitude));
  }
}

void parse_row(std::string_view text, CsvTable& table, std::vector<Precision>& columns) {
  std::size_t column = 0;
  bool commas = false, semicolons = false;
  for (bool more = true; more;) {
    const Number n = take_number(text);
    table.values.push_back(n.value);
    table.digits.push_back(static_cast<std::int16_t>(std::clamp(n.digit, -1000, 1000)));
    if (column == columns.size()) columns.emplace_back();
    Precision& precision = columns[column++];
    precision.decimals = std::max<int>(precision.decimals, -table.digits.back());
    precision.significant = std::max(precision.significant, n.significant);
    skip_blanks(text);
    more = !text.empty();
    const bool comma = skip(text, ','), semicolon = !comma && skip(text, ';');
    commas |= comma;
    semicolons |= semicolon;
    mc::require(!commas || !semicolons, "both ',' and ';' separate; write decimal points, and one of the two between");
    if (comma || semicolon) {
      skip_blanks(text);
      more = !text.empty(); // a separator may end the row
    }
  }
}

// Bytes that no editor or spreadsheet writes into a table indicate an image, an archive or UTF-16.
void require_text(const std::string& file, const std::string& bytes) {
  const auto control = [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f'; };
  const auto bad = std::find_if(bytes.begin(), bytes.end(), control);
  if (bad == bytes.end()) return;
  throw mc::Error(fmt::format("{}: it is not text: byte {} is 0x{:02x}; rows of numbers are needed", file,
                              bad - bytes.begin(), static_cast<unsigned>(static_cast<unsigned char>(*bad))));
}

// Makes room for a number of rows like the first one, which the table contains.
void reserve(CsvTable& table, std::size_t rows, const std::string& file) {
  const double bytes_of_number = sizeof(double) + 2 * sizeof(std::int16_t);
  mc::require_memory(double(rows) * (double(table.columns) * bytes_of_number + sizeof(std::uint32_t)),
                     fmt::format("{}: {} rows of {} numbers", file, rows, table.columns));
  table.values.reserve(rows * table.columns);
  table.digits.reserve(rows * table.columns);
  table.lines.reserve(rows);
}

} // namespace

void CsvTable::keep_every(std::size_t step) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows(); i += step, ++kept) {
    lines[kept] = lines[i];
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t to = kept * columns + k, from = i * columns + k;
      values[to] = values[from];
      digits[to] = digits[from];
      digits_below[to] = digits_below[from];
    }
  }
  lines.resize(kept);
  values.resize(kept * columns);
  digits.resize(kept * columns);
  digits_below.resize(kept * columns);
}

CsvTable read_csv(const std::string& file) {
  const std::string bytes = mc::read_file(file);
  require_text(file, bytes);
  CsvTable table;
  std::vector<Precision> columns;
  std::uint32_t line = 0;
  bool first = true;
  const char line_end = bytes.find('\n') == std::string::npos ? '\r' : '\n'; // line ends of old spreadsheets
  for (std::string_view rest = bytes; !rest.empty();) {
    std::string_view text = rest.substr(0, rest.find(line_end));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    ++line;
    if (line == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    text = without_comment(text);
    skip_blanks(text);
    if (text.empty()) continue;
    const std::size_t before = table.values.size();
    try {
      mc::require(std::count(text.begin(), text.end(), '"') % 2 == 0, unclosed);
      if (std::exchange(first, false) && is_header(text)) continue;
      parse_row(text, table, columns);
      const std::size_t found = table.values.size() - before;
      if (table.lines.empty()) {
        table.columns = found;
        reserve(table, 1 + static_cast<std::size_t>(std::count(rest.begin(), rest.end(), line_end)) + 1, file);
      }
      mc::require(found == table.columns, "{} numbers; the rows before have {}", found, table.columns);
    } catch (const mc::Error& e) {
      throw mc::Error(fmt::format("{}:{}: {}", file, line, mc::printable(e.what())));
    }
    table.lines.push_back(line);
  }
  mc::require(!table.lines.empty(), "{}: it contains no numbers", file);
  refine_digits(table, columns);
  return table;
}

} // namespace carlo
