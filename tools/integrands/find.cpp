#include <integrands/box_map.h>
#include <integrands/find.h>
#include <integrands/genz.h>
#include <integrands/joint_integrand.h>
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
    set.f = [expression = set.expression, outputs = set.integrands.size(),
             dim = static_cast<std::size_t>(set.dim())](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
      for (std::size_t i = 0; i < values.size() / outputs; ++i)
        expression->evaluate(points.subspan(i * dim, dim), values.subspan(i * outputs, outputs));
    };
    return set;
  }
  for (const std::string& text : texts) {
    set.texts.push_back(set.integrands.size());
    set.integrands.push_back(find_integrand(text, context));
  }
  set.f = joined(set.integrands).f;
  return set;
}

double measure_of(const IntegrandSet& set, std::string_view option) {
  if (set.expression) return set.expression->uniform_measure(option);
  const std::vector<VariableBounds>& bounds = set.integrands.front().bounds;
  for (const VariableBounds& s : bounds)
    mc::require(s.is_finite(), "{}: the domain is infinite along {}; values need a finite volume", option, s.name);
  return BoxMap(bounds).volume();
}

} // namespace carlo
