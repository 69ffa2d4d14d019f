#pragma once
/// Random integrands with known integrals, to test the coverage of error bars.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <string_view>

namespace carlo {

/// A class of integrands and the function that draws one. Position, dimension, shape and size are random; the truth is
/// in closed form.
struct IntegrandClass {
  std::string_view name, title;
  bool finite_variance;
  UnitCubeIntegral (*draw)(std::uint64_t seed);
};

/// All classes, with their ranges of dimensions. Every integrand is multiplied by a power of two between 2^-40 and
/// 2^40.
///   step     : 1 below a threshold on each axis; 1 to 3.
///   box      : 1 between two thresholds on each axis; 1 to 3.
///   jump     : a step times exp(c . x); 2 to 8.
///   kink     : product of 1 + c |x - a|; 1 to 6.
///   shell    : 1 between two spheres; 2 and 3.
///   singular : product of |x - a|^-p with p up to .4, a at 0 or inside; 1 to 3.
///   infinite : the same with p from .5 to .95, so that the variance is infinite; 1 and 2.
///   peaks    : up to 3 Gaussians anywhere; 2 to 6.
///   ridge    : a Gaussian with rotated axes; 2 and 3.
///   needle   : a long thin Gaussian with rotated axes; 4 and 5.
///   wave     : cos(b + c . x); 1 to 8.
///   product  : product of |4 x - 2|^p; 5 to 20.
///   aligned  : functions whose edges or periods fit low-discrepancy points, so that the error falls in steps: a half
///              plane with an edge of small whole slope, a wave of a Gaussian variable, equal steps, a jump near a
///              multiple of 1/64 with or times an exponential; 1 and 2.
const std::vector<IntegrandClass>& integrand_classes();

} // namespace carlo
