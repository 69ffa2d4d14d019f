#include <mc/estimate/integrate/mean.h>

#include <mc/stats/t_test.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

double welch(const Mean& a, const Mean& b) { return welch_dof(a.variance, a.dof, b.variance, b.dof); }

std::optional<double> deviate(const Mean& a, const Mean& b) {
  const double error = std::sqrt(a.variance + b.variance);
  if (!(error > 0) || !std::isfinite(error)) return {};
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double t =
      std::abs(a.value - b.value) / std::hypot(error, rounding * std::max(std::abs(a.value), std::abs(b.value)));
  const double tail = cdf(complement(boost::math::students_t(welch(a, b)), t));
  return quantile(complement(boost::math::normal(), std::max(tail, 1e-300)));
}

} // namespace mc::detail
