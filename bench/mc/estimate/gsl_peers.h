#pragma once
/// Integrals by GSL, called as its users would.

#include <integrands/unit_cube_integral.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/sobol.h>

#include <gsl/gsl_monte_miser.h>
#include <gsl/gsl_monte_plain.h>
#include <gsl/gsl_monte_vegas.h>

#include <cmath>
#include <span>
#include <vector>

namespace bench {

using carlo::UnitCubeIntegral;

inline double call(double* x, std::size_t dim, void* data) {
  return static_cast<const UnitCubeIntegral*>(data)->f(std::span<const double>(x, dim));
}

struct Gsl {
  const UnitCubeIntegral& e;
  std::size_t dim, calls;
  gsl_monte_function f;
  std::vector<double> lo, hi;
  gsl_rng* rng;

  Gsl(const UnitCubeIntegral& experiment, std::size_t calls_, unsigned long seed)
      : e(experiment), dim(static_cast<std::size_t>(e.dim)),
        calls(calls_), f{call, dim, const_cast<UnitCubeIntegral*>(&e)}, lo(dim), hi(dim, 1.0),
        rng(gsl_rng_alloc(gsl_rng_mt19937)) {
    gsl_rng_set(rng, seed);
  }
  ~Gsl() { gsl_rng_free(rng); }
  Gsl(const Gsl&) = delete;
  Gsl& operator=(const Gsl&) = delete;

  double plain() {
    double value, error;
    auto* s = gsl_monte_plain_alloc(dim);
    gsl_monte_plain_integrate(&f, lo.data(), hi.data(), dim, calls, rng, s, &value, &error);
    gsl_monte_plain_free(s);
    return value;
  }
  double miser() {
    double value, error;
    auto* s = gsl_monte_miser_alloc(dim);
    gsl_monte_miser_integrate(&f, lo.data(), hi.data(), dim, calls, rng, s, &value, &error);
    gsl_monte_miser_free(s);
    return value;
  }
  // Five iterations with a fifth of the calls each, as in the manual.
  double vegas() {
    double value, error;
    auto* s = gsl_monte_vegas_alloc(dim);
    gsl_monte_vegas_integrate(&f, lo.data(), hi.data(), dim, calls / 5, rng, s, &value, &error);
    gsl_monte_vegas_free(s);
    return value;
  }
  // Two warm-up iterations on a fifth of the calls, then four on the rest.
  double vegas_warm() {
    double value, error;
    auto* s = gsl_monte_vegas_alloc(dim);
    gsl_monte_vegas_params p;
    gsl_monte_vegas_params_get(s, &p);
    p.iterations = 2;
    gsl_monte_vegas_params_set(s, &p);
    gsl_monte_vegas_integrate(&f, lo.data(), hi.data(), dim, calls / 10, rng, s, &value, &error);
    gsl_monte_vegas_params_get(s, &p);
    p.iterations = 4;
    p.stage = 1;
    gsl_monte_vegas_params_set(s, &p);
    gsl_monte_vegas_integrate(&f, lo.data(), hi.data(), dim, calls / 5, rng, s, &value, &error);
    gsl_monte_vegas_free(s);
    return value;
  }
  // Sixteen Cranley-Patterson shifts of Sobol's sequence. Uses the sequence of libmc, because GSL has only 40
  // dimensions.
  double shifted_sobol() {
    mc::Moments means;
    const mc::Sobol sobol;
    const std::uint64_t each = calls / 16;
    std::vector<double> shift(dim), x(dim);
    for (int r = 0; r < 16; ++r) {
      for (double& s : shift) s = gsl_rng_uniform(rng);
      double sum = 0;
      for (std::uint32_t i = 1; i <= each; ++i) {
        for (std::size_t d = 0; d < dim; ++d) {
          x[d] = shift[d] + 0x1p-32 * sobol.unscrambled(i, static_cast<std::uint32_t>(d));
          x[d] -= x[d] >= 1 ? 1.0 : 0.0;
        }
        sum += call(x.data(), dim, f.params);
      }
      means.add(sum / double(each));
    }
    return means.mean();
  }
};

} // namespace bench
