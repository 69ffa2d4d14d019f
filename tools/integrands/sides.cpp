#include <integrands/expression.h>
#include <integrands/sides.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace carlo {

std::string_view trimmed(std::string_view text) {
  constexpr const char* white = " \t\n\v\f\r";
  text.remove_prefix(std::min(text.find_first_not_of(white), text.size()));
  return text.substr(0, text.find_last_not_of(white) + 1);
}

namespace {

double number(std::string_view text, std::string_view side) {
  const std::optional<double> value = mc::number_in(trimmed(text));
  mc::require(value && !std::isnan(*value), "--domain: '{}' in '{}' is not a number, inf or -inf", text, side);
  return *value;
}

} // namespace

std::vector<Side> parse_sides(const std::string& box) {
  std::vector<Side> sides;
  for (std::size_t begin = 0; begin <= box.size();) {
    const std::size_t end = std::min(box.find(',', begin), box.size());
    const std::string_view side = trimmed(std::string_view(box).substr(begin, end - begin));
    const std::size_t equals = side.find('='), colon = side.find(':');
    mc::require(equals != std::string::npos && equals > 0 && colon != std::string::npos && colon > equals,
                "--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"", side);
    Side s{std::string(trimmed(side.substr(0, equals))), number(side.substr(equals + 1, colon - equals - 1), side),
           number(side.substr(colon + 1), side)};
    mc::with_context("--domain", [&] { require_variable(s.name); });
    mc::require(s.lo < s.hi, "--domain: '{}' has bounds {} and {}; lo < hi is needed", side, s.lo, s.hi);
    for (const Side& other : sides) mc::require(other.name != s.name, "--domain: '{}' is bounded twice", s.name);
    sides.push_back(s);
    begin = end + 1;
  }
  return sides;
}

} // namespace carlo
