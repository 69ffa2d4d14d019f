#include <mc/stats/t_test.h>

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace mc {

TTest t_test(double mean, double error, double dof, double value, double alpha) {
  require(std::isfinite(value), "t_test: value {} must be finite", value);
  require(alpha > 0 && alpha < 1, "t_test: alpha {} must lie in (0, 1)", alpha);
  TTest result;
  // Equal values have no standard error: the test passes or fails exactly.
  if (!(error > 0)) {
    result.t = mean == value ? 0.0 : std::copysign(HUGE_VAL, mean - value);
    result.p = mean == value ? 1.0 : 0.0;
    return result;
  }
  result.t = (mean - value) / error;
  result.p = student_tail(result.t, dof);
  const boost::math::students_t student(dof);
  result.detectable = error * (boost::math::quantile(boost::math::complement(student, alpha / 2)) +
                               boost::math::quantile(student, 0.99));
  return result;
}

double welch_dof(double variance_a, double dof_a, double variance_b, double dof_b) {
  const double sum = variance_a + variance_b; // squares of shares of the sum do not underflow
  return sum > 0 ? 1 / (sqr(variance_a / sum) / dof_a + sqr(variance_b / sum) / dof_b) : dof_a + dof_b;
}

double student_tail(double t, double dof) {
  return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(dof), std::abs(t)));
}

double student_quantile(double p, double dof) {
  return boost::math::quantile(boost::math::complement(boost::math::students_t(dof), p / 2));
}

} // namespace mc
