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
// Student's t at the probability of one sigma.
double one_sigma(double dof) { return dof > 0 ? two_sided(dof, cdf(complement(boost::math::normal(), 1.0))) : 1.0; }
} // namespace

Estimate Estimate::student(double value, double error, double dof, std::uint64_t count) {
  return {value, error * one_sigma(dof), dof, count};
}
double Estimate::error() const { return std_error / one_sigma(dof); }

Estimate::Interval Estimate::interval(double confidence) const {
  require(confidence > 0 && confidence < 1, "Estimate: confidence {} must lie in (0, 1)", confidence);
  const double half = two_sided(dof, 0.5 * (1 - confidence)) * error();
  return {value - half, value + half};
}

Estimate Moments::estimate() const {
  require(non_finite_ == 0, "Moments: {} of {} values are not finite, the first at index {}", non_finite_,
          non_finite_ + count_, witness_);
  require(count_ >= 2, "Moments: {} values; a standard error needs at least 2", count_);
  return Estimate::student(mean_, std_error(), static_cast<double>(count_ - 1), count_);
}

} // namespace mc
