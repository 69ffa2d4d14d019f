#include <integrands/expression.h>
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

UnitCubeIntegral find_integrand(const std::string& text, const std::string& bounds) {
  if (!bounds.empty()) return parse_expression(text, bounds);
  std::vector<std::string_view> names;
  for (const UnitCubeIntegral* e : named_integrands()) {
    if (e->name == text) return *e;
    names.push_back(e->name);
  }
  const bool a_name =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!a_name) return parse_expression(text, bounds);
  throw mc::Error(fmt::format("unknown integrand '{}'{}; --list shows them all; for an expression give --domain",
                              abbreviate(text), mc::did_you_mean(text, names)));
}

} // namespace carlo
