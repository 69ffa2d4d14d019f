#include <mc/core/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
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

std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
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
