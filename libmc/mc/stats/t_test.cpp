#include <mc/core/error.h>
#include <mc/stats/t_test.h>

#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace mc {

TTest t_test(const Moments& moments, double value, double alpha) {
  require(std::isfinite(value), "t_test: value {} must be finite", value);
  require(alpha > 0 && alpha < 1, "t_test: alpha {} must lie in (0, 1)", alpha);
  const Estimate e = moments.estimate();
  const double error = moments.std_error();
  const boost::math::students_t student(e.dof);
  TTest result;
  // Equal values have no standard error: they agree or they do not.
  if (!(error > 0)) {
    result.t = e.value == value ? 0.0 : std::copysign(HUGE_VAL, e.value - value);
    result.p = e.value == value ? 1.0 : 0.0;
    return result;
  }
  result.t = (e.value - value) / error;
  result.p = 2 * boost::math::cdf(boost::math::complement(student, std::abs(result.t)));
  result.detectable = error * (boost::math::quantile(boost::math::complement(student, alpha / 2)) +
                               boost::math::quantile(student, 0.99));
  return result;
}

} // namespace mc
