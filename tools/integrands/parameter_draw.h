#pragma once
/// Random dimensions, parameters and scales of integrands.

#include <integrands/unit_cube_integral.h>

#include <mc/random/pcg.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace carlo {

/// Draws the dimension, the parameters and the scale of one integrand.
struct ParameterDraw {
  mc::Pcg random;
  int dim;
  double scale; ///< a power of two between 2^-40 and 2^40; multiplies the integrand and its integral

  /// A dimension between `least` and `most`, both included.
  ParameterDraw(std::uint64_t seed, int least, int most) : random(seed), dim(integer(least, most)), scale(1) {
    scale = std::ldexp(1.0, integer(-40, 40));
  }
  double between(double lo, double hi) { return lo + (hi - lo) * random.uniform<double>(); }
  int integer(int lo, int hi) { return std::min(hi, static_cast<int>(std::floor(between(lo, hi + 1)))); }
  /// One number per axis.
  std::vector<double> each(double lo, double hi) {
    std::vector<double> v(static_cast<std::size_t>(dim));
    for (double& x : v) x = between(lo, hi);
    return v;
  }
  /// The integrand scale * f, whose integral is scale * truth.
  UnitCubeIntegral made(const char* name, double truth, std::function<double(std::span<const double>)> f) const {
    return {name,
            fmt::format("{} in {} dimensions", name, dim),
            "made by machine",
            dim,
            scale * truth,
            {},
            0,
            [f = std::move(f), s = scale](std::span<const double> x) { return s * f(x); }};
  }
};

/// The product of term(0), ..., term(n - 1).
template <class Term> double product(std::size_t n, Term&& term) {
  double p = 1;
  for (std::size_t i = 0; i < n; ++i) p *= term(i);
  return p;
}
/// The sum of term(0), ..., term(n - 1).
template <class Term> double sum(std::size_t n, Term&& term) {
  double s = 0;
  for (std::size_t i = 0; i < n; ++i) s += term(i);
  return s;
}

} // namespace carlo
