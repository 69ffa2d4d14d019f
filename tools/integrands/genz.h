#pragma once
/// Genz's families of test integrals.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// The six families in 2, 5 and 8 dimensions, named genz_FAMILY_Dd: oscillatory, product_peak, corner_peak, gaussian,
/// c0 and discontinuous. Their fixed parameters have Genz's difficulties 6, 18, 2.2, 15.2, 16.1 and 16.4. The true
/// values are in closed form.
///   Source : [Genz87], difficulties of [Hahn05].
const std::vector<UnitCubeIntegral>& genz_integrals();

} // namespace carlo
