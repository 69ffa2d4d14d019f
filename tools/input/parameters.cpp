#include <input/parameters.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace carlo {

namespace {

constexpr double most_sets = 10000;

// A part of an option's text, for error messages.
struct Part {
  std::string_view option, part, text;
};

double number(std::string_view word, const Part& of) {
  const std::optional<double> value = mc::parse_double(word);
  mc::require(value && std::isfinite(*value),
              "{}: '{}' in '{}' is not of the form name=number, as in \"alpha=0.1,n=3\"", of.option, of.part, of.text);
  return *value;
}

// One number, or first:last:step.
std::vector<double> values_of(std::string_view words, const Part& of) {
  const std::vector<std::string_view> ends = mc::split(words, ':');
  if (ends.size() == 1) return {number(ends[0], of)};
  mc::require(ends.size() == 3, "{}: '{}' in '{}' is not of the form name=first:last:step", of.option, of.part,
              of.text);
  const double first = number(ends[0], of), last = number(ends[1], of), step = number(ends[2], of);
  const double steps = (last - first) / step;
  mc::require(step != 0 && steps >= 0, "{}: '{}' in '{}' does not lead from {} to {}", of.option, of.part, of.text,
              first, last);
  mc::require(steps < most_sets, "{}: '{}' has {:.0f} values; at most {:.0f} are taken", of.option, of.part, steps + 1,
              most_sets);
  std::vector<double> values;
  for (int k = 0; k <= steps + 1e-9; ++k)
    values.push_back(std::strtod(fmt::format("{:.12g}", first + k * step).c_str(), nullptr));
  return values;
}

} // namespace

ParameterLists parse_lists(const std::string& text, std::string_view option) {
  ParameterLists lists;
  for (const std::string_view part : mc::split(text, ',')) {
    const Part of{option, part, text};
    const std::size_t equals = part.find('=');
    std::string_view words = part;
    if (equals != std::string_view::npos && equals > 0) {
      const std::string name(mc::trimmed(part.substr(0, equals)));
      for (const auto& other : lists)
        mc::require(other.first != name, "{}: '{}' stands twice in '{}'", option, name, text);
      lists.emplace_back(name, std::vector<double>());
      words.remove_prefix(equals + 1);
    }
    mc::require(!lists.empty(), "{}: '{}' in '{}' is not of the form name=number, as in \"alpha=0.1,n=3\"", option,
                part, text);
    const std::vector<double> values = values_of(mc::trimmed(words), of);
    lists.back().second.insert(lists.back().second.end(), values.begin(), values.end());
  }
  return lists;
}

std::vector<ParameterSet> parse_parameters(const std::string& text) {
  std::vector<ParameterSet> sets(1);
  for (const auto& [name, values] : parse_lists(text, "--params")) {
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
