#pragma once
/// One integrand for each class of smoothness, in each dimension: what the table of convergence rates is measured on.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// rate_CLASS_Dd in 1, 2, 3, 5 and 8 dimensions, true values in closed form:
///   smooth    : product of e^x
///   axis_jump : 1 where all x < 2/3; 2^m strata of an axis never end there, and all miss it by the same 1/3 or 2/3
///   kink      : |a . x - b|, a turned against all axes
///   jump      : 1 where a . x < b
///   corner    : product of x^-0.15
const std::vector<UnitCubeIntegral>& rate_integrals();

} // namespace carlo
