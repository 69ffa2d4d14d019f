#include <mc/core/text.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace mc {

std::optional<double> parse_double(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return {};
  if (error != std::errc::result_out_of_range) return value;
  const double rounded = std::strtod(std::string(text).c_str(), nullptr);
  return std::isinf(rounded) ? std::nullopt : std::optional(rounded);
}

namespace {

// Number of bytes of the UTF-8 character at the start of a text; 0 where none is or where a terminal would obey it.
std::size_t printable_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const auto length = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  std::uint32_t code = byte(0) & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_character = code >= least[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
  const bool is_obeyed = code < 0xa0 || (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
                         (code >= 0x2060 && code <= 0x206f) || code == 0x61c || code == 0xfeff;
  return is_character && !is_obeyed ? length : 0;
}

} // namespace

std::string printable(std::string_view text, std::size_t longest) {
  if (text.size() > longest) {
    const std::size_t kept = longest / 2;
    return printable(text.substr(0, kept), longest) + " ... " + printable(text.substr(text.size() - kept), longest);
  }
  std::string line;
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    line += length > 0 ? text.substr(0, length) : "?";
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return line;
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* white = " \t\n\v\f\r";
  text.remove_prefix(std::min(text.find_first_not_of(white), text.size()));
  return text.substr(0, text.find_last_not_of(white) + 1);
}

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

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1); // distances of the last three prefixes of a
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = last;
    last = row;
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (a[i] != b[j]), row[j] + 1, last[j + 1] + 1});
      const bool swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (swapped) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

namespace {

// The letters in lower case, without '-' and '_'.
std::string folded(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (c != '-' && c != '_') letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return letters;
}

} // namespace

std::optional<std::size_t> spelling_distance(std::string_view word, std::string_view name) {
  const std::string a = folded(word), b = folded(name);
  const std::size_t distance = edit_distance(a, b);
  if (distance > std::max<std::size_t>(a.size() / 3, 1) || distance >= std::max(a.size(), b.size())) return {};
  return distance;
}

} // namespace mc
