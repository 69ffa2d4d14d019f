#include <integrands/expression.h>
#include <integrands/variable_bounds.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <cmath>
#include <string_view>

namespace carlo {
namespace {

// A number, inf, or a constant expression with a finite value, such as 2*_pi.
double bound(std::string_view text, std::string_view side) {
  const std::string word(mc::trimmed(text));
  if (const auto number = mc::parse_double(word); number && !std::isnan(*number)) return *number;
  const std::string context =
      fmt::format("--domain: '{}' in '{}' is not a number, inf, -inf or a constant expression", word, side);
  const double value = mc::with_context(context, [&] { return parse_function(word, {})({}); });
  mc::require(std::isfinite(value), "--domain: '{}' in '{}' is {}, not a number, inf or -inf", word, side, value);
  return value;
}

} // namespace

std::vector<VariableBounds> parse_bounds(const std::string& box) {
  std::vector<VariableBounds> bounds;
  for (const std::string_view side : mc::split(box, ',')) {
    const std::size_t equals = side.find('='), colon = side.find(':');
    mc::require(equals != std::string::npos && equals > 0 && colon != std::string::npos && colon > equals,
                "--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"", side);
    VariableBounds s{std::string(mc::trimmed(side.substr(0, equals))),
                     bound(side.substr(equals + 1, colon - equals - 1), side), bound(side.substr(colon + 1), side)};
    mc::with_context("--domain", [&] { require_variable_name(s.name); });
    mc::require(s.lo < s.hi, "--domain: '{}' has bounds {} and {}; lo < hi is needed", side, s.lo, s.hi);
    for (const VariableBounds& other : bounds)
      mc::require(other.name != s.name, "--domain: '{}' is bounded twice", s.name);
    bounds.push_back(s);
  }
  return bounds;
}

} // namespace carlo
