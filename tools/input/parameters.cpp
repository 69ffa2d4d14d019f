#include <input/parameters.h>
#include <input/words.h>

#include <mc/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace carlo {

namespace {

constexpr double most_sets = 10000;

double number(std::string_view word, std::string_view part, std::string_view text) {
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  mc::require(error == std::errc() && stop == end && std::isfinite(value),
              "--params: '{}' in '{}' is not of the form name=number, as in \"alpha=0.1,n=3\"", part, text);
  return value;
}

// One number, or first:last:step.
std::vector<double> values_of(std::string_view words, std::string_view part, std::string_view text) {
  const std::vector<std::string_view> ends = split(words, ':');
  if (ends.size() == 1) return {number(ends[0], part, text)};
  mc::require(ends.size() == 3, "--params: '{}' in '{}' is not of the form name=first:last:step", part, text);
  const double first = number(ends[0], part, text), last = number(ends[1], part, text),
               step = number(ends[2], part, text);
  const double steps = (last - first) / step;
  mc::require(step != 0 && steps >= 0, "--params: '{}' in '{}' does not lead from {} to {}", part, text, first, last);
  mc::require(steps < most_sets, "--params: '{}' has {:.0f} values; at most {:.0f} are taken", part, steps + 1,
              most_sets);
  std::vector<double> values;
  for (double k = 0; k <= steps + 1e-9; ++k)
    values.push_back(std::strtod(fmt::format("{:.12g}", first + k * step).c_str(), nullptr));
  return values;
}

} // namespace

std::vector<ParameterSet> parse_parameters(const std::string& text) {
  std::vector<std::pair<std::string, std::vector<double>>> swept;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    std::string_view words = part;
    if (equals != std::string_view::npos && equals > 0) {
      const std::string name(split(part.substr(0, equals), ',')[0]);
      for (const auto& other : swept)
        mc::require(other.first != name, "--params: '{}' stands twice in '{}'", name, text);
      swept.emplace_back(name, std::vector<double>());
      words.remove_prefix(equals + 1);
    }
    mc::require(!swept.empty(), "--params: '{}' in '{}' is not of the form name=number, as in \"alpha=0.1,n=3\"", part,
                text);
    const std::vector<double> values = values_of(split(words, ',')[0], part, text);
    swept.back().second.insert(swept.back().second.end(), values.begin(), values.end());
  }

  std::vector<ParameterSet> sets(1);
  for (const auto& [name, values] : swept) {
    mc::require(static_cast<double>(sets.size() * values.size()) <= most_sets,
                "--params: '{}' stands for more than {:.0f} sets", text, most_sets);
    std::vector<ParameterSet> longer;
    for (const ParameterSet& set : sets)
      for (const double value : values) longer.emplace_back(set).emplace_back(name, value);
    sets = std::move(longer);
  }
  return sets;
}

} // namespace carlo
