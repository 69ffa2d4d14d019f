#pragma once
/// Integrals over the unit cube, and the textbook integrals with their true values.

#include <integrands/variable_bounds.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The smoothness class of an integrand, which determines the convergence rate of samplers.
///   additive  : smooth, a sum of functions of one coordinate each.
///   axis_kink : Lipschitz, with kinks parallel to the axes; kink: with kinks in any other surface.
///   axis_jump : jumps at faces parallel to the axes; jump: at any other surface.
///   corner    : product of x^-corner_exponent; if the exponent is < 0, the slope at 0 is infinite.
///   matching_faces : equal values on opposite faces of the cube, but different slopes.
struct Smoothness {
  enum class Class { unknown, smooth, additive, periodic, axis_kink, kink, axis_jump, jump, corner };
  Class kind = Class::unknown;
  double corner_exponent = 0;
  bool matching_faces = false;
};
std::string_view name(Smoothness::Class c);

/// An integral over the unit cube.
struct UnitCubeIntegral {
  using UnitPoint = std::span<const double>;

  std::string name;
  std::string title; ///< one line, for lists and plots
  std::string source;
  int dim;
  double truth; ///< NaN if unknown
  Smoothness smoothness;
  double min_fit_n;                     ///< smallest N in the asymptotic range; 0 if unknown
  std::function<double(UnitPoint u)> f; ///< the integrand at u in [0,1)^dim; its mean is the integral
  /// Evaluates several points, stored one after another; may be empty.
  std::function<void(UnitPoint points, std::span<double> values)> f_batch = {};
  std::function<std::string(UnitPoint u)> describe_point =
      {}; ///< "x = 0.5, y = 1": the point in the original domain; may be empty
  /// Variables that map_to_bounds takes from u; NaN where another map does. Empty: u itself.
  std::vector<VariableBounds> bounds = {};
  /// Whether the value at u underflows to 0 although the value of its expression does not; may be empty.
  std::function<bool(UnitPoint u)> underflows_at = {};
};

/// Evaluates the integrand at each of the points.
///   throws : Error with the first point at which it is not finite.
void evaluate(const UnitCubeIntegral& e, UnitCubeIntegral::UnitPoint points, std::span<double> values);

/// Throws Error if 4096 values are all 0 and some of them underflow. Callers use it for an integrand that was 0 at
/// every point, since the volume of its domain may be the cause.
void refuse_underflow(const UnitCubeIntegral& e);

const std::vector<UnitCubeIntegral>& textbook_integrals();

} // namespace carlo
