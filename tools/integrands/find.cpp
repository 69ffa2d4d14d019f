#include <integrands/expression.h>
#include <integrands/find.h>
#include <integrands/genz.h>
#include <integrands/rate_integrals.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <cctype>

namespace carlo {

std::vector<const Experiment*> named_integrands() {
  std::vector<const Experiment*> all;
  for (const auto* list : {&experiments(), &genz_integrals(), &rate_integrals()})
    for (const Experiment& e : *list) all.push_back(&e);
  return all;
}

Experiment find_integrand(const std::string& text, const std::string& bounds) {
  if (!bounds.empty()) return parse_expression(text, bounds);
  std::vector<std::string_view> names;
  for (const Experiment* e : named_integrands()) {
    if (e->name == text) return *e;
    names.push_back(e->name);
  }
  const bool a_name =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!a_name) return parse_expression(text, bounds);
  throw mc::Error(fmt::format("unknown integrand '{}'{}; --list shows them all; for an expression give --domain",
                              abridged(text), mc::did_you_mean(text, names)));
}

} // namespace carlo
