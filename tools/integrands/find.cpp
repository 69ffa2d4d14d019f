#include <integrands/find.h>
#include <integrands/genz.h>
#include <integrands/rate_integrals.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cctype>

namespace carlo {

std::vector<const UnitCubeIntegral*> named_integrands() {
  std::vector<const UnitCubeIntegral*> all;
  for (const auto* list : {&textbook_integrals(), &genz_integrals(), &rate_integrals()})
    for (const UnitCubeIntegral& e : *list) all.push_back(&e);
  return all;
}

namespace {

// Bounds that follow those of --domain after a blank are an argument of their own.
void refuse_bounds(const std::string& text, const std::string& domain) {
  if (!is_domain(text)) return;
  throw mc::Error(fmt::format("'{0}' is a bound and not an integrand; --domain takes all bounds as one argument: "
                              "--domain \"{1}{0}\"",
                              abbreviate(text), domain.empty() ? "" : domain + ","));
}

} // namespace

UnitCubeIntegral find_integrand(const std::string& text, const ExpressionContext& context) {
  refuse_bounds(text, context.domain);
  if (!context.domain.empty()) return parse_expression(text, context);
  std::vector<std::string_view> names;
  for (const UnitCubeIntegral* e : named_integrands()) {
    if (e->name == text) {
      mc::require(context == ExpressionContext(),
                  "'{}' has a domain of its own; --where, --let, --set and --nan are "
                  "for an expression with --domain",
                  text);
      return *e;
    }
    names.push_back(e->name);
  }
  const bool a_name =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!a_name) return parse_expression(text, context);
  throw mc::Error(fmt::format("unknown integrand '{}'{}; --list shows them all; for an expression give --domain",
                              abbreviate(text), mc::did_you_mean(text, names)));
}

IntegrandSet find_integrands(const std::vector<std::string>& texts, const ExpressionContext& context) {
  for (const std::string& text : texts) refuse_bounds(text, context.domain);
  IntegrandSet set;
  if (!context.domain.empty()) {
    set.expression = std::make_shared<ExpressionIntegral>(context, texts);
    set.integrands = integrands_of(set.expression, texts, context.domain);
    for (const ExpressionIntegral::Output& o : set.expression->outputs()) set.texts.push_back(o.text);
    return set;
  }
  for (const std::string& text : texts) {
    set.texts.push_back(set.integrands.size());
    set.integrands.push_back(find_integrand(text, context));
    mc::require(set.integrands.back().dim == set.dim(),
                "integrate: '{}' has {} dimensions, '{}' {}; they must be the same", text, set.integrands.back().dim,
                set.integrands.front().name, set.dim());
  }
  return set;
}

void evaluate(const IntegrandSet& set, UnitCubeIntegral::UnitPoint points, std::span<double> values) {
  if (set.f) return set.f(points, values);
  const std::size_t outputs = set.integrands.size(), dim = static_cast<std::size_t>(set.dim());
  for (std::size_t i = 0; i < values.size() / outputs; ++i) {
    const UnitCubeIntegral::UnitPoint u = points.subspan(i * dim, dim);
    const std::span<double> at = values.subspan(i * outputs, outputs);
    if (set.expression) set.expression->evaluate(u, at);
    else
      for (std::size_t k = 0; k < outputs; ++k) at[k] = set.integrands[k].f(u);
  }
}

double measure_of(const IntegrandSet& set, std::string_view option) {
  if (set.expression) return set.expression->uniform_measure(option);
  double volume = 1;
  for (const VariableBounds& s : set.integrands.front().bounds) {
    mc::require(s.is_finite(), "{}: the domain is infinite along {}; values need a finite volume", option, s.name);
    volume *= s.hi - s.lo;
  }
  return volume;
}

} // namespace carlo
