#pragma once
/// Checks that external code computes a function.

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace carlo {

/// Evaluates points, stored one after another, and sets all outputs of each.
using EvalPoints = std::function<void(std::span<const double> points, std::span<double> values)>;

/// An integrand that is evaluated in two ways, which must agree.
struct PureCheck {
  std::string name;
  std::size_t dim, outputs;
  std::function<void(std::size_t i, std::span<double> x)> point; ///< sets x to the i-th point
  EvalPoints each;                                               ///< one point
  EvalPoints many;                                               ///< several points; may be empty
  std::string many_name, many_remedy;                            ///< for messages
};

/// Evaluates up to 253 points for about a tenth of a second: forwards, backwards, and in batches of every small size.
///   throws : Error with the point at which two values differ by more than rounding.
void require_pure(const PureCheck& check);

} // namespace carlo
