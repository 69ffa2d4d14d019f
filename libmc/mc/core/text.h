#pragma once
/// Parsing of numbers and words, and suggestions for misspelled names.

#include <mc/core/error.h>

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// Parses a text that consists of one number, such as "+1.5e3", "inf" or "nan". Independent of the locale.
///   underflow : returns 0 with the sign of the number.
///   nullopt   : for any other text, and for a finite number too large for a double.
std::optional<double> parse_double(std::string_view text);

/// The text without white space and line ends at its start and end.
std::string_view trimmed(std::string_view text);

/// The text as one line for a terminal. Replaces control characters, characters that change the direction of text, and
/// bytes that are not UTF-8 by question marks. Cuts the middle of a text of more than `longest` bytes.
std::string printable(std::string_view text, std::size_t longest = 2000);

/// Splits at each separator and trims the parts: "a, b,,c" gives "a", "b", "", "c".
std::vector<std::string_view> split(std::string_view text, char separator);

/// Number of edits that turn one word into the other. An edit inserts, deletes or replaces a character, or swaps two
/// neighbours.
///   Source : [WagnerFischer74].
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Edit distance of two names, ignoring case, '-' and '_'. Returns nullopt if it exceeds a third of the letters of
/// `word`, or 1 for a short word: the names then hardly mean the same.
std::optional<std::size_t> spelling_distance(std::string_view word, std::string_view name);

/// Returns "; did you mean 'sobol'?" for the entry of `known` that is spelled most like `word`, or "" if no entry is
/// close.
template <class Range> std::string did_you_mean(std::string_view word, const Range& known) {
  std::string_view best;
  std::optional<std::size_t> best_distance;
  for (const auto& k : known) {
    const std::optional<std::size_t> d = spelling_distance(word, k);
    if (d && (!best_distance || *d < *best_distance)) {
      best = k;
      best_distance = d;
    }
  }
  return best.empty() ? std::string() : fmt::format("; did you mean '{}'?", best);
}

/// Index of `word` in `names`. `kind` names the kind of thing for the message.
///   throws : Error such as "unknown sampler 'sobal'; did you mean 'sobol'?; use one of independent, stratified,
///            sobol".
template <class Range> std::size_t index_of(std::string_view kind, std::string_view word, const Range& names) {
  std::size_t i = 0;
  for (const auto& name : names) {
    if (name == word) return i;
    ++i;
  }
  throw Error(
      fmt::format("unknown {} '{}'{}; use one of {}", kind, word, did_you_mean(word, names), fmt::join(names, ", ")));
}

} // namespace mc
