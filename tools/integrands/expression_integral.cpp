#include <integrands/expression_integral.h>
#include <integrands/special_functions.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carlo {

using Frame = ExpressionProgram::Frame;

// Builds the steps in an order in which every expression comes after the values that it uses.
struct ExpressionIntegral::Builder {
  struct Pending {
    std::string option, name, text; ///< a condition has no name
  };

  ExpressionIntegral& integral;
  std::vector<std::string> names, constants; ///< known so far; those with a constant value
  std::vector<double> constant_values;
  std::vector<Pending> pending;
  long double measure = 1; // long double: sides may be large and small in any order

  static bool uses_only(const std::string& text, const std::vector<std::string>& known) {
    const std::vector<std::string> used = variables_of(text);
    return std::all_of(used.begin(), used.end(), [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) != known.end();
    });
  }

  std::size_t add_name(const std::string& name, double initial = 0) {
    names.push_back(name);
    return integral.program_.add_value(name, initial);
  }
  void add_constant(const std::string& name, double value) {
    add_name(name, value);
    constants.push_back(name);
    constant_values.push_back(value);
  }

  void add(const Pending& p) {
    mc::with_context(p.option, [&] {
      if (!p.name.empty() && uses_only(p.text, constants))
        return add_constant(p.name, parse_function(p.text, constants)(constant_values));
      const std::size_t expression = integral.program_.add_expression(p.text);
      const StepKind kind = p.name.empty() ? StepKind::condition : StepKind::let;
      const std::size_t value = p.name.empty() ? 0 : add_name(p.name), before = integral.variables_.size();
      integral.steps_.push_back({kind, value, expression, {}, {}, 0, before, false});
    });
  }
  // Adds what was pending and now has all of its values.
  void add_ready() {
    for (std::size_t i = 0; i < pending.size();) {
      if (!uses_only(pending[i].text, names)) {
        ++i;
        continue;
      }
      const Pending p = pending[i];
      pending.erase(pending.begin() + static_cast<std::ptrdiff_t>(i));
      add(p);
      i = 0; // a condition or another let may have waited for it
    }
  }

  Parameter parameter(const std::string& text, const VariableText& v) {
    if (uses_only(text, constants) || mc::parse_double(text))
      return {parse_bound(text, v.text, constants, constant_values)};
    return {0, mc::with_context(fmt::format("--domain: '{}' in '{}' may use the variables before it", text, v.text),
                                [&] { return integral.program_.add_expression(text); })};
  }

  void add(const VariableText& v) {
    Step step{StepKind::interval,         0,    0, parameter(v.first, v), parameter(v.second, v), 0,
              integral.variables_.size(), false};
    const double a = step.first.value, b = step.second.value;
    switch (v.kind) {
    case VariableText::Kind::interval:
      mc::require(!step.is_constant() || a < b, "--domain: '{}' has bounds {} and {}; lo < hi is needed", v.text, a, b);
      step.is_box_side = step.is_constant() && std::isfinite(a) && std::isfinite(b);
      if (step.is_box_side) measure *= b - a;
      break;
    case VariableText::Kind::normal:
      step.kind = StepKind::normal;
      mc::require(!step.first.is_constant() || std::isfinite(a), "--domain: '{}' has the mean {}; it must be finite",
                  v.text, a);
      mc::require(!step.second.is_constant() || (b > 0 && std::isfinite(b)),
                  "--domain: '{}' has the standard deviation {}; it must be > 0 and finite", v.text, b);
      break;
    case VariableText::Kind::integers:
      if (step.first.is_constant()) step.first.value = std::ceil(a);
      if (step.second.is_constant()) step.second.value = std::floor(b);
      step.kind = StepKind::summed_integers;
      mc::require(!step.is_constant() || step.first.value <= step.second.value,
                  "--domain: no whole number lies between the bounds of '{}'", v.text);
      if (std::isinf(a) || std::isinf(b) || (step.is_constant() && b - a >= summed_terms))
        step.kind = StepKind::coordinate_integer;
      break;
    }
    if (step.kind != StepKind::summed_integers) step.coordinate = static_cast<std::size_t>(integral.coordinates_++);
    step.value = add_name(v.name);
    integral.variables_.push_back(v);
    integral.variable_values_.push_back(step.value);
    integral.steps_.push_back(step);
  }
};

std::pair<std::string, std::string> split_definition(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  mc::require(equals != text.npos && equals > 0 && equals + 1 < text.size() && text[equals + 1] != '=',
              "{} '{}' is not of the form name=value", option, text);
  std::string name(mc::trimmed(text.substr(0, equals)));
  mc::with_context(option, [&] { require_variable_name(name); });
  return {std::move(name), std::string(mc::trimmed(text.substr(equals + 1)))};
}

ExpressionIntegral::ExpressionIntegral(const ExpressionContext& context, const std::vector<std::string>& expressions)
    : nan_(context.nan), replaced_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
  Builder builder{*this, {}, {}, {}, {}};
  const std::vector<VariableText> domain = split_domain(context.domain);
  mc::require(domain.size() <= 1024, "--domain: {} variables; at most 1024 are possible", domain.size());
  std::vector<std::string> taken(domain.size());
  std::transform(domain.begin(), domain.end(), taken.begin(), [](const VariableText& v) { return v.name; });
  const auto define = [&](std::string_view option, const std::string& text) {
    auto definition = split_definition(option, text);
    mc::require(std::find(taken.begin(), taken.end(), definition.first) == taken.end(),
                "{}: '{}' has a meaning already; choose another name", option, definition.first);
    taken.push_back(definition.first);
    return definition;
  };
  for (const std::string& text : context.settings) {
    const auto definition = define("--set", text);
    const std::string& value = definition.second;
    mc::require(value.find(':') == value.npos, "--set '{}': one value is needed here; carlo integrate takes ranges",
                text);
    builder.add_constant(definition.first,
                         mc::with_context(fmt::format("--set '{}'", text), [&] { return parse_number(value); }));
  }
  for (const std::string& text : context.lets) {
    const auto [name, value] = define("--let", text);
    builder.pending.push_back({fmt::format("--let '{}'", abbreviate(text)), name, value});
  }
  for (const std::string& text : context.conditions)
    builder.pending.push_back({fmt::format("--where '{}'", abbreviate(text)), "", text});
  builder.add_ready();
  for (const VariableText& v : domain) {
    builder.add(v);
    builder.add_ready();
  }
  // What is left has unknown names, of which its expression complains.
  for (const Builder::Pending& p : builder.pending) builder.add(p);
  names_ = builder.names;
  for (std::size_t i = 0; i < expressions.size(); ++i) add_output(i, expressions[i]);

  constant_measure_ = static_cast<double>(builder.measure);
  mc::require(std::isfinite(constant_measure_), "--domain: the volume of '{}' overflows", context.domain);
  mc::require(constant_measure_ >= std::numeric_limits<double>::min(),
              "--domain: the volume of '{}' is too small for a double", context.domain);
}

void ExpressionIntegral::add_output(std::size_t index, const std::string& text) {
  if (has_name("i") || !uses_imaginary_unit(text)) {
    outputs_.push_back({index, Part::whole, program_.add_expression(text)});
    return;
  }
  complex_.emplace_back(text, program_);
  outputs_.push_back({index, Part::real, complex_.size() - 1});
  if (!complex_.back().is_real_valued()) outputs_.push_back({index, Part::imaginary, complex_.size() - 1});
}

double ExpressionIntegral::part_of(std::complex<double> z, const Output& output) const {
  if (output.part == Part::imaginary) return z.imag();
  // As in real expressions, the square root of a negative number is not a number.
  const bool is_undefined = complex_[output.value].is_real_valued() && z.imag() != 0;
  return is_undefined ? std::numeric_limits<double>::quiet_NaN() : z.real();
}

std::string ExpressionIntegral::describe(const Frame& frame, std::size_t variables) const {
  return first_variables(variables, [&](std::size_t i) {
    return fmt::format("{} = {:.9g}", variables_[i].name, frame[variable_values_[i]]);
  });
}

void ExpressionIntegral::refuse(const Step& step, const Frame& frame, std::string_view complaint,
                                std::string_view remedy) const {
  const std::string place = describe(frame, step.variable);
  throw mc::Error(fmt::format("--domain: '{}' {}{}{}; {}", variables_[step.variable].text, complaint,
                              place.empty() ? "" : " at ", place, remedy));
}

double ExpressionIntegral::take(const Step& step, std::span<const double> u, const Frame& frame) const {
  if (step.kind == StepKind::let) {
    frame[step.value] = frame.evaluate(step.expression);
    return 1;
  }
  if (step.kind == StepKind::condition) {
    const double holds = frame.evaluate(step.expression);
    mc::require(!std::isnan(holds), "--where: a condition is not a number at {}; it must be true or false there",
                describe(frame, step.variable));
    return holds != 0;
  }
  const double a = step.first.in(frame), b = step.second.in(frame), v = u[step.coordinate];
  if (step.kind == StepKind::normal) {
    if (!(b > 0 && std::isfinite(a) && std::isfinite(b)))
      refuse(step, frame, fmt::format("has the mean {:.9g} and the standard deviation {:.9g}", a, b),
             "both must be finite, the second > 0");
    frame[step.value] = a + b * normal_quantile_of(v);
    return std::isfinite(frame[step.value]); // an end at infinity is no point of the domain
  }
  if (!(a <= b))
    refuse(step, frame, fmt::format("has bounds {:.9g} and {:.9g}", a, b),
           "lo <= hi is needed; --where restricts the variables before");
  if (a == b && step.kind == StepKind::interval) return 0;
  const MappedPoint at =
      step.kind == StepKind::interval ? map_to_bounds(a, b, v) : map_to_integers(std::ceil(a), std::floor(b), v);
  frame[step.value] = at.x;
  if (std::isinf(at.x)) return 0;
  return at.slope;
}

std::pair<double, int> ExpressionIntegral::summed_range(const Step& step, const Frame& frame) const {
  const double lo = std::ceil(step.first.in(frame)), hi = std::floor(step.second.in(frame));
  const double terms = hi - lo + 1;
  if (!(terms <= summed_terms))
    refuse(step, frame, fmt::format("has bounds {:.9g} and {:.9g}", lo, hi),
           fmt::format("at most {} terms are summed at a point; a sum to inf is sampled", summed_terms));
  return {lo, static_cast<int>(std::max(terms, 0.0))};
}

double ExpressionIntegral::replaced() const {
  ++*replaced_;
  return *nan_;
}

void ExpressionIntegral::evaluate(std::span<const double> u, std::span<double> values) const {
  std::fill(values.begin(), values.end(), 0.0);
  visit(u, [&](double weight, const Frame& frame) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * value(frame, i);
  });
}

double ExpressionIntegral::evaluate(std::span<const double> u, std::size_t output) const {
  double sum = 0;
  visit(u, [&](double weight, const Frame& frame) { sum += weight * value(frame, output); });
  return sum;
}

bool ExpressionIntegral::underflows_at(std::span<const double> u, std::size_t output) const {
  bool any = false;
  visit(u, [&](double weight, const Frame& frame) {
    const double y = value(frame, output);
    // A value that is itself nearly 0 belongs to the far tail of a peak and is no underflow of the product.
    any = any || (weight * y == 0 && std::abs(y) >= std::numeric_limits<double>::min());
  });
  return any;
}

std::string ExpressionIntegral::describe_point(std::span<const double> u) const {
  std::string text;
  bool found = false;
  visit(u, [&](double, const Frame& frame) {
    if (found) return;
    for (std::size_t i = 0; i < outputs_.size(); ++i) found = found || !std::isfinite(value(frame, i));
    if (found || text.empty()) text = describe(frame, variables_.size());
  });
  return text.empty() ? "a point outside the domain" : text;
}

bool ExpressionIntegral::has_finite_bounds() const {
  return std::all_of(steps_.begin(), steps_.end(), [](const Step& s) {
    if (s.kind == StepKind::let || s.kind == StepKind::condition) return true;
    return s.kind != StepKind::normal && std::isfinite(s.first.value) && std::isfinite(s.second.value);
  });
}

double ExpressionIntegral::uniform_measure(std::string_view option) const {
  for (const Step& s : steps_) {
    if (s.kind == StepKind::let || s.kind == StepKind::normal) continue;
    mc::require(s.kind != StepKind::condition, "{}: it needs a box; --where makes it another region", option);
    const VariableText& v = variables_[s.variable];
    mc::require(s.kind == StepKind::interval && s.is_constant(),
                "{}: it needs a box of constant bounds; '{}' is not one of its sides", option, v.text);
    mc::require(std::isfinite(s.first.value) && std::isfinite(s.second.value),
                "{}: the domain is infinite along {}; values need a finite volume", option, v.name);
  }
  return constant_measure_;
}

bool ExpressionIntegral::has_name(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::vector<VariableBounds> ExpressionIntegral::coordinate_bounds() const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<VariableBounds> bounds;
  for (const Step& s : steps_) {
    if (s.kind == StepKind::interval && s.is_constant())
      bounds.push_back({variables_[s.variable].name, s.first.value, s.second.value});
    else if (s.kind == StepKind::interval || s.kind == StepKind::normal || s.kind == StepKind::coordinate_integer)
      bounds.push_back({variables_[s.variable].name, unknown, unknown});
  }
  return bounds;
}

std::optional<double> ExpressionIntegral::value_at(std::string_view variable, double u) const {
  for (const Step& s : steps_) {
    const bool is_mapped = s.kind == StepKind::interval || s.kind == StepKind::normal;
    if (!is_mapped || variables_[s.variable].name != variable || !s.is_constant()) continue;
    if (s.kind == StepKind::normal) return s.first.value + s.second.value * normal_quantile_of(u);
    return map_to_bounds(s.first.value, s.second.value, u).x;
  }
  return {};
}

std::vector<UnitCubeIntegral> integrands_of(const std::shared_ptr<const ExpressionIntegral>& integral,
                                            const std::vector<std::string>& texts, const std::string& domain) {
  std::vector<UnitCubeIntegral> all;
  const std::vector<ExpressionIntegral::Output>& outputs = integral->outputs();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const bool is_complex = std::count_if(outputs.begin(), outputs.end(), [&](const ExpressionIntegral::Output& o) {
                              return o.text == outputs[i].text;
                            }) > 1;
    const bool is_imaginary = outputs[i].part == ExpressionIntegral::Part::imaginary;
    std::string name = texts[outputs[i].text];
    if (is_complex) name = fmt::format("{}({})", is_imaginary ? "im" : "re", name);
    UnitCubeIntegral e{.name = name,
                       .title = name,
                       .source = domain,
                       .dim = integral->dim(),
                       .truth = std::numeric_limits<double>::quiet_NaN(),
                       .smoothness = {},
                       .min_fit_n = 0,
                       .f = [integral, i](std::span<const double> u) { return integral->evaluate(u, i); }};
    e.underflows_at = [integral, i](std::span<const double> u) { return integral->underflows_at(u, i); };
    e.bounds = integral->coordinate_bounds();
    e.describe_point = [integral](std::span<const double> u) { return integral->describe_point(u); };
    all.push_back(std::move(e));
  }
  return all;
}

UnitCubeIntegral parse_expression(const std::string& expression, const ExpressionContext& context) {
  mc::require(!context.domain.empty(),
              "'{}' is not a name of --list; for an expression give --domain, as in \"x=0:1,y=-1:2\"",
              abbreviate(expression));
  const auto integral = std::make_shared<const ExpressionIntegral>(context, std::vector{expression});
  mc::require(integral->outputs().size() == 1, "'{}' is complex; take re(...), im(...) or abs(...) of it",
              abbreviate(expression));
  return integrands_of(integral, {expression}, context.domain).front();
}

} // namespace carlo
