#include <mc/core/error.h>
#include <mc/estimate/moments.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace mc {

namespace {
double two_sided(double dof, double tail) {
  return dof > 0 ? quantile(complement(boost::math::students_t(dof), tail))
                 : quantile(complement(boost::math::normal(), tail));
}
// Student's t at the coverage of one sigma.
double one_sigma(double dof) { return dof > 0 ? two_sided(dof, cdf(complement(boost::math::normal(), 1.0))) : 1.0; }
} // namespace

Estimate Estimate::from_student_t(double value, double error, double dof, std::uint64_t count) {
  return {value, error * one_sigma(dof), dof, count};
}
double Estimate::unwidened_std_error() const { return std_error / one_sigma(dof); }

Estimate::Interval Estimate::interval(double confidence) const {
  require(confidence > 0 && confidence < 1, "Estimate: confidence {} must lie in (0, 1)", confidence);
  const double half = two_sided(dof, 0.5 * (1 - confidence)) * unwidened_std_error();
  return {value - half, value + half};
}

Estimate Moments::estimate() const {
  require(non_finite_ == 0, "Moments: {} of {} values are not finite, the first at index {}", non_finite_,
          non_finite_ + count_, first_non_finite_);
  require(count_ >= 2, "Moments: {} values; a standard error needs at least 2", count_);
  return Estimate::from_student_t(mean_, std_error(), static_cast<double>(count_ - 1), count_);
}

} // namespace mc
