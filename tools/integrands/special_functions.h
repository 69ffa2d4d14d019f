#pragma once
/// Functions of expressions beyond those of the parser.

#include <span>
#include <variant>

namespace carlo {

/// A function by its name in expressions. Outside its domain it is NaN; it never throws.
struct NamedFunction {
  const char* name;
  const char* arguments; ///< "(nu, x)"
  std::variant<double (*)(double), double (*)(double, double)> f;
  const char* help; ///< meaning and conventions; may be empty
};

/// erf, gamma, besselj and others, in the order of --help.
std::span<const NamedFunction> special_functions();

/// The x with P(Z <= x) = p for a standard normal Z; -inf and inf at 0 and 1, NaN outside.
double normal_quantile_of(double p);

} // namespace carlo
