#pragma once
/// Sixteen integrals for measurements of time: cheap integrands of many kinds with exact values.

#include <integrands/unit_cube_integral.h>

#include <vector>

namespace bench {

/// The first eight are smooth, kinked, cut, correlated, thin, singular, clipped and high-dimensional; eight more follow.
std::vector<carlo::UnitCubeIntegral> seconds_integrals();

} // namespace bench
