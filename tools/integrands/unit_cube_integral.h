#pragma once
/// The integrals of the books, each with its true value.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// How smooth an integrand is, which decides how fast samplers converge.
///   additive  : smooth, a sum of functions of one coordinate each
///   axis_kink : Lipschitz, its bends parallel to the axes; kink: in any other surface
///   axis_jump : jumps at faces parallel to the axes; jump: at any other surface
///   corner    : product of x^-corner_exponent; where that is < 0 the slope is infinite there
///   matching_faces : it has the same values on opposite faces of the cube, but other slopes
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
  double truth; ///< NaN: unknown
  Smoothness smoothness;
  double min_fit_n;                     ///< smallest N in the asymptotic range; 0: unknown
  std::function<double(UnitPoint u)> f; ///< of u in [0,1)^dim; its mean is the integral
  /// Several at once, points one after another; may be empty.
  std::function<void(UnitPoint points, std::span<double> values)> f_batch = {};
  std::function<std::string(UnitPoint u)> describe_point =
      {}; ///< "x = 0.5, y = 1", the point of its own domain; may be empty
  /// Whether the value at u is 0 since it is too small for a double, and that of its expression is not; may be empty.
  std::function<bool(UnitPoint u)> underflows_at = {};
};

/// The integrand at each of the points.
///   throws : Error with the first place where it is not finite
void evaluate(const UnitCubeIntegral& e, UnitCubeIntegral::UnitPoint points, std::span<double> values);

/// Throws Error where 4096 values are all 0 and some of them underflow: to be asked of an integrand that was 0 at every
/// point, which may be the volume's doing.
void refuse_underflow(const UnitCubeIntegral& e);

const std::vector<UnitCubeIntegral>& textbook_integrals();

} // namespace carlo
