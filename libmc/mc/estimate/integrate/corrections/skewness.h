#pragma once
/// Second correction of the error bar: the interval is longer on the side to which the replicates are skewed.

#include <mc/estimate/integrate/corrections/tuning.h>

#include <span>

namespace mc::detail {

/// Third cumulant of the mean of independent numbers, over its standard error cubed, divided by 6, times the share of
/// the correction that is in use; 0 where the numbers are equal to within rounding.
double skew_of_mean(std::span<const double> numbers, const Tuning& t = default_tuning);

/// Shift of the end of a t interval on the side of the skewness.
///   assumes : The numbers are independent with a finite third moment.
///   formula : skew error (1 + 2 t^2) [Johnson78], with the quantile t of Student's distribution. The other end stays:
///             a shorter interval there would only compensate the error of the skewness.
///   why     : The mean of few replicates of a skewed integrand is skewed.
inline double skewness_shift(double skew, double error, double quantile) {
  return skew * error * (1 + 2 * quantile * quantile);
}

} // namespace mc::detail
