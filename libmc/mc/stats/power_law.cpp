#include <mc/stats/power_law.h>
#include <mc/stats/scale.h>

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace mc {

namespace {

// Moments of the errors in units of 2^exponent.
struct ErrorMoments {
  double squares = 0, fourths = 0; ///< Means of the squares and fourth powers.
  int exponent = 0;

  ErrorMoments(std::span<const double> estimates, double truth) {
    std::vector<double> all(estimates.begin(), estimates.end());
    all.push_back(truth);
    exponent = largest_exponent(all);
    const double r = static_cast<double>(estimates.size());
    for (const double x : estimates) {
      const double off = std::ldexp(x, -exponent) - std::ldexp(truth, -exponent);
      squares += sqr(off) / r;
      fourths += sqr(sqr(off)) / r;
    }
  }
  double kurtosis() const { return squares > 0 ? fourths / sqr(squares) : 0; }
};

} // namespace

double error_kurtosis(std::span<const double> estimates, double truth) {
  return ErrorMoments(estimates, truth).kurtosis();
}

// The mean of r squares of kurtosis k has relative variance (k - 1) / r.
// Chi-square with d degrees of freedom has 2 / d.
double effective_error_count(double r, double kurtosis) {
  return kurtosis > 3 ? std::max(1.0, 2 * r / (kurtosis - 1)) : r;
}

RmsError rms_error(double n, std::span<const double> estimates, double truth, double kurtosis) {
  require(estimates.size() >= 2, "rms_error: {} estimates; at least 2 are needed", estimates.size());
  require(std::isfinite(truth), "rms_error: truth {} must be finite", truth);
  for (std::size_t i = 0; i < estimates.size(); ++i)
    require(std::isfinite(estimates[i]), "rms_error: estimates[{}] = {} is not finite", i, estimates[i]);
  const ErrorMoments m(estimates, truth);
  const double degrees = effective_error_count(static_cast<double>(estimates.size()), std::max(m.kurtosis(), kurtosis));
  const boost::math::chi_squared distribution(degrees);
  RmsError result;
  result.n = n;
  result.rms = std::ldexp(std::sqrt(m.squares), m.exponent);
  result.lo = std::ldexp(std::sqrt(m.squares * degrees / quantile(complement(distribution, 0.025))), m.exponent);
  result.hi = std::ldexp(std::sqrt(m.squares * degrees / quantile(distribution, 0.025)), m.exponent);
  return result;
}

PowerLaw fit_power_law(std::span<const RmsError> errors, std::uint32_t repetitions) {
  require(errors.size() >= 3, "fit_power_law: {} points; at least 3 are needed", errors.size());
  require(repetitions >= 1, "fit_power_law: {} repetitions; at least 1 is needed", repetitions);
  const double count = static_cast<double>(errors.size());
  double mean_x = 0, mean_y = 0;
  for (const RmsError& e : errors) {
    require(e.n > 0 && std::isfinite(e.n), "fit_power_law: N = {} must be finite and > 0", e.n);
    require(e.rms > 0 && std::isfinite(e.rms), "fit_power_law: the error at N = {} is {}; it must be finite and > 0",
            e.n, e.rms);
    mean_x += std::log(e.n) / count;
    mean_y += std::log(e.rms) / count;
  }
  double xx = 0, xy = 0;
  for (const RmsError& e : errors) {
    xx += sqr(std::log(e.n) - mean_x);
    xy += (std::log(e.n) - mean_x) * (std::log(e.rms) - mean_y);
  }
  require(xx > 0, "fit_power_law: all {} points have N = {}; a slope needs two different N", errors.size(),
          errors[0].n);
  PowerLaw law;
  law.slope = xy / xx;
  law.constant = std::exp(mean_y - law.slope * mean_x);
  double scatter = 0;
  for (const RmsError& e : errors) scatter += sqr(std::log(e.rms) - mean_y - law.slope * (std::log(e.n) - mean_x));
  const double dof = count - 2;
  const double t = quantile(complement(boost::math::students_t(dof), 0.025));
  const double half = std::max(1.96 * std::sqrt(1 / (2.0 * repetitions) / xx), t * std::sqrt(scatter / dof / xx));
  law.lo = law.slope - half;
  law.hi = law.slope + half;
  return law;
}

} // namespace mc
