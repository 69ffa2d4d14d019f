#pragma once
/// Finds integrands by name or by expression.

#include <integrands/expression_integral.h>
#include <integrands/unit_cube_integral.h>

namespace carlo {

/// All integrands with a name: textbook, Genz and rate integrals.
std::vector<const UnitCubeIntegral*> named_integrands();

/// The integrand with this name. With a domain, or if the text is not a name, it is an expression.
///   throws : Error for an unknown name, with the nearest one, for bounds instead of an integrand, and for an invalid
///            expression or invalid bounds.
UnitCubeIntegral find_integrand(const std::string& text, const ExpressionContext& context);

/// Several integrands over one domain. A complex expression is two integrands, its real and its imaginary part.
struct IntegrandSet {
  std::vector<UnitCubeIntegral> integrands;
  std::vector<std::size_t> texts;                      ///< the text of each integrand
  std::shared_ptr<ExpressionIntegral> expression = {}; ///< null if they are no expressions
  /// Evaluates all integrands at several points, see JointIntegrand.
  std::function<void(UnitCubeIntegral::UnitPoint points, std::span<double> values)> f = {};
  bool has_importance_density = false; ///< the points are not uniform

  int dim() const { return integrands.front().dim; }
  /// Whether integrands k and k + 1 are the parts of a complex expression.
  bool is_complex(std::size_t k) const { return k + 1 < texts.size() && texts[k] == texts[k + 1]; }
  bool is_exact_sum() const { return expression && expression->is_exact_sum() && !has_importance_density; }
};

/// All expressions over the domain of the context; without one the integrands with these names.
///   throws : Error as find_integrand, and for names with different dimensions.
IntegrandSet find_integrands(const std::vector<std::string>& texts, const ExpressionContext& context);

/// The measure of the domain; 1 for named integrands. Throws Error that begins with `option` for an infinite domain,
/// and as ExpressionIntegral::uniform_measure.
double measure_of(const IntegrandSet& set, std::string_view option);

} // namespace carlo
