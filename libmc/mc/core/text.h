#pragma once
/// What a message says about a name that is not known.

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace mc {

/// Number of single-character edits (insert, delete, replace) between two words. Source: [WagnerFischer74]
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'sobol'?" for the entry of `known` nearest to `word`; empty when none is near.
template <class Range> std::string did_you_mean(std::string_view word, const Range& known) {
  std::string_view best;
  std::size_t best_distance = word.size() / 2 + 2;
  for (const auto& k : known) {
    const std::size_t d = edit_distance(word, k);
    if (d < best_distance) {
      best = k;
      best_distance = d;
    }
  }
  return best.empty() ? std::string() : fmt::format("; did you mean '{}'?", best);
}

} // namespace mc
