#pragma once
/// Random sums and compositions of integrands with known integrals, to test the coverage of error bars.

#include <integrands/random_integrands.h>

#include <vector>

namespace carlo {

/// All classes. Every integrand is multiplied by a power of two between 2^-40 and 2^40.
///   sum             : a constant, linear, exponential or oscillating function, plus or minus an integrand of another
///                     class, except needle, on some of the axes. The mean sizes differ by a factor between 1e-3 and
///                     1e3; 1 to 8 dimensions.
///   sum_infinite    : the same with a product of |x - a|^-p of infinite variance.
///   nested          : exp, log, square, min or max of a step, kink, wave, power or sum; 1 to 8 dimensions.
///   nested_infinite : a square or maximum of powers that has infinite variance; 2 to 4 dimensions.
const std::vector<IntegrandClass>& composed_integrand_classes();

} // namespace carlo
