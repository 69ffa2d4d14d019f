#pragma once
/// Integrands made by machine, to try what an error bar promises.

#include <integrands/unit_cube_integral.h>

#include <cstdint>
#include <string_view>

namespace carlo {

/// A kind of integrand and how one is drawn: place, dimension, shape and size are random, the truth is in closed form.
struct IntegrandClass {
  std::string_view name, title;
  bool finite_variance;
  UnitCubeIntegral (*draw)(std::uint64_t seed);
};

/// step: 1 below a place on each axis, d 1 to 3. box: 1 between two. jump: a step times exp(c . x), 2 to 8.
/// kink: a product of 1 + c |x - a|, 1 to 6. shell: 1 between two spheres, 2 and 3. singular: a product of |x - a|^-p
/// with p up to .4, a at 0 or inside, 1 to 3. infinite: so too, p from .5 to .95. peaks: up to 3 Gaussians anywhere,
/// 2 to 6. ridge: a Gaussian whose axes are turned, 2 and 3; needle: 4 and 5. wave: cos(b + c . x), 1 to 8.
/// product: of |4 x - 2|^p, 5 to 20. All are multiplied by a power of two between 2^-40 and 2^40.
const std::vector<IntegrandClass>& integrand_classes();

} // namespace carlo
