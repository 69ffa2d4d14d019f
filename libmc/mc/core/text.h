#pragma once
/// Numbers and words in text, and what a message says about a name that is not known.

#include <mc/core/error.h>

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mc {

/// The number that all of a text is, "+1.5e3", "inf" and "nan" too: what is too small is 0 with its sign. Nothing where
/// it is anything else or too large for a double: infinite is only what says so. Knows no locale.
std::optional<double> parse_double(std::string_view text);

/// Without the white space at its ends, ends of lines too.
std::string_view trimmed(std::string_view text);

/// With a question mark for every byte that is no printable ASCII: what a file calls things, in a message of one line.
std::string printable(std::string text);

/// What stands between separators, trimmed: "a, b,,c" is "a", "b", "", "c".
std::vector<std::string_view> split(std::string_view text, char separator);

/// Number of edits between two words: insert, delete or replace a character, or swap two neighbours.
/// Source: [WagnerFischer74]
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Edit distance of two names, where upper case, '-' and '_' do not count. Nothing where it exceeds a third of the
/// letters of `word`, or 1 for a short word: then the names hardly mean the same.
std::optional<std::size_t> spelling_distance(std::string_view word, std::string_view name);

/// "; did you mean 'sobol'?" for the entry of `known` whose spelling is nearest to `word`; empty when none is near.
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

/// The place of `word` among the names of a kind of thing.
///   throws : Error "unknown sampler 'sobal'; did you mean 'sobol'?; use one of independent, stratified, sobol"
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
