#pragma once
/// One integrand for each smoothness class and dimension. The table of convergence rates is measured on them.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// rate_CLASS_Dd in 1, 2, 3, 5 and 8 dimensions, with true values in closed form:
///   smooth    : product of e^x.
///   axis_jump : 1 where all x < 2/3. The 2^m strata of an axis never end at 2/3; all have the same excess of 1/3 or
///               2/3 of a stratum.
///   kink      : |a . x - b|, where a is parallel to no axis.
///   jump      : 1 where a . x < b.
///   corner    : product of x^-0.15.
const std::vector<UnitCubeIntegral>& rate_integrals();

} // namespace carlo
