#pragma once
/// Sixteen integrals for measurements of time: cheap integrands of many kinds with exact values.

#include <integrands/unit_cube_integral.h>

#include <vector>

namespace bench {

/// Smooth, kinked, cut, correlated, thin, singular, clipped and high-dimensional ones, and eight more.
std::vector<carlo::UnitCubeIntegral> seconds_integrals();

} // namespace bench
