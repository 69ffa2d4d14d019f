#pragma once
/// Integrals on which clever densities were found to do harm, or no good.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// Ten in 2 to 50 dimensions, named hard_KIND, their truths in closed form: two peaks on a diagonal, a product of
/// |4 x - 2| in 20 dimensions, an Asian option on a geometric mean of 50 prices, a box at a random place, a thin shell,
/// a ridge that follows no axis, a ring, a corner and a pole of power laws, a ball.
const std::vector<UnitCubeIntegral>& hard_integrals();

} // namespace carlo
