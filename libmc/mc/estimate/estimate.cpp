#include <mc/core/error.h>
#include <mc/estimate/moments.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace mc {

Estimate::Interval Estimate::interval(double confidence) const {
  require(confidence > 0 && confidence < 1, "Estimate: confidence {} must lie in (0, 1)", confidence);
  const double tail = 0.5 * (1 - confidence);
  const double t = dof > 0 ? quantile(complement(boost::math::students_t(dof), tail))
                           : quantile(complement(boost::math::normal(), tail));
  return {value - t * std_error, value + t * std_error};
}

Estimate Moments::estimate() const {
  require(non_finite_ == 0, "Moments: {} of {} values are not finite, the first at index {}", non_finite_,
          non_finite_ + count_, witness_);
  require(count_ >= 2, "Moments: {} values; a standard error needs at least 2", count_);
  return {mean_, std_error(), static_cast<double>(count_ - 1), count_};
}

} // namespace mc
