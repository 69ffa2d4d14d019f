#pragma once
/// Integrals that are hard for adaptive densities.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// Ten integrals in 2 to 50 dimensions, named hard_KIND, with exact values in closed form. Smooth ones: two peaks on a
/// diagonal, a ridge along no axis, and a ring. Discontinuous ones: a box at a random place, a thin shell, and a ball.
/// Others: a product of |4 x - 2| in 20 dimensions, an Asian option on a geometric mean of 50 prices, and a corner and
/// a pole of power laws.
const std::vector<UnitCubeIntegral>& hard_integrals();

} // namespace carlo
