#include <integrands/expression.h>
#include <integrands/variable_bounds.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>

namespace carlo {
namespace {

using Kind = VariableText::Kind;

// The parts of a text between separators outside parentheses, trimmed.
std::vector<std::string_view> split_outside_parentheses(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0 || !text.substr(i).starts_with(separator)) continue;
    parts.push_back(mc::trimmed(text.substr(start, i - start)));
    i += separator.size() - 1;
    start = i + 1;
  }
  parts.push_back(mc::trimmed(text.substr(start)));
  return parts;
}

// Fills the mean and the standard deviation of "normal" or "normal(mean, sigma)"; false for other text.
bool read_normal(std::string_view range, VariableText& v) {
  constexpr std::string_view word = "normal";
  if (!range.starts_with(word)) return false;
  const std::string_view rest = mc::trimmed(range.substr(word.size()));
  v.kind = Kind::normal;
  v.first = "0";
  v.second = "1";
  if (rest.empty()) return true;
  if (!rest.starts_with('(') || !rest.ends_with(')')) return false;
  const std::vector<std::string_view> arguments = split_outside_parentheses(rest.substr(1, rest.size() - 2), ",");
  mc::require(arguments.size() == 2, "--domain: '{}' needs a mean and a standard deviation, as in \"z=normal(0, 1)\"",
              v.text);
  v.first = arguments[0];
  v.second = arguments[1];
  return true;
}

bool read_range(std::string_view range, VariableText& v) {
  if (read_normal(range, v)) return true;
  for (const auto& [separator, kind] : {std::pair("..", Kind::integers), std::pair(":", Kind::interval)}) {
    const std::vector<std::string_view> bounds = split_outside_parentheses(range, separator);
    if (bounds.size() != 2) continue;
    v.kind = kind;
    v.first = bounds[0];
    v.second = bounds[1];
    return true;
  }
  return false;
}

} // namespace

std::vector<VariableText> split_domain(std::string_view domain) {
  std::vector<VariableText> all;
  for (const std::string_view text : split_outside_parentheses(domain, ",")) {
    mc::require(text.find(';') == text.npos,
                "--domain: '{}' contains ';'; a comma separates variables, as in \"x=0:1,y=-1:2\"", text);
    const std::size_t equals = std::min(text.find('='), text.size());
    VariableText v{std::string(text), std::string(mc::trimmed(text.substr(0, equals))), Kind::interval, "", ""};
    mc::require(equals > 0 && equals < text.size() && read_range(mc::trimmed(text.substr(equals + 1)), v),
                "--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"", text);
    mc::with_context("--domain", [&] { require_variable_name(v.name); });
    for (const VariableText& other : all) mc::require(other.name != v.name, "--domain: '{}' is bounded twice", v.name);
    all.push_back(std::move(v));
  }
  return all;
}

bool is_domain(std::string_view text) {
  try {
    return !split_domain(text).empty();
  } catch (const mc::Error&) {
    return false;
  }
}

double parse_bound(const std::string& text, std::string_view whole, const std::vector<std::string>& names,
                   const std::vector<double>& values) {
  if (const auto number = mc::parse_double(text); number && !std::isnan(*number)) return *number;
  const std::string context =
      fmt::format("--domain: '{}' in '{}' is not a number, inf, -inf or a constant expression", text, whole);
  const double value = mc::with_context(context, [&] { return parse_function(text, names)(values); });
  mc::require(std::isfinite(value), "--domain: '{}' in '{}' is {}, not a number, inf or -inf", text, whole, value);
  return value;
}

std::vector<VariableBounds> parse_bounds(const std::string& box) {
  std::vector<VariableBounds> bounds;
  for (const VariableText& v : split_domain(box)) {
    mc::require(v.kind == Kind::interval, "--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"",
                v.text);
    const VariableBounds s{v.name, parse_bound(v.first, v.text), parse_bound(v.second, v.text)};
    mc::require(s.lo < s.hi, "--domain: '{}' has bounds {} and {}; lo < hi is needed", v.text, s.lo, s.hi);
    bounds.push_back(s);
  }
  return bounds;
}

MappedPoint map_to_integers(double lo, double hi, double u) {
  if (std::isfinite(lo) && std::isfinite(hi)) {
    const double count = hi - lo + 1;
    return {lo + std::min(std::floor(u * count), count - 1), count};
  }
  if (std::isinf(lo) && std::isinf(hi)) {
    const MappedPoint half = map_to_integers(0, hi, u >= 0.5 ? 2 * u - 1 : 2 * u);
    return {u >= 0.5 ? half.x : -1 - half.x, 2 * half.slope};
  }
  const double j = std::floor(u / (1 - u));
  return {std::isfinite(lo) ? lo + j : hi - j, (j + 1) * (j + 2)};
}

} // namespace carlo
