#pragma once
/// Estimates with error bars.

#include <cstdint>

namespace mc {

/// An estimate with its error bar. If the mean is normal, value +- std_error has the coverage of one sigma, 68.27 %,
/// for any number of values.
struct Estimate {
  double value = 0; ///< Estimated value.
  /// Half the width of the 68.27 % interval: the standard error of the mean, widened for its own uncertainty.
  double std_error = 0;
  double dof = 0;          ///< Degrees of freedom of std_error, or 0 if it is exact.
  std::uint64_t count = 0; ///< Number of values behind the estimate.

  /// Estimate from the standard error of a mean, itself estimated with `dof` degrees of freedom. std_error becomes the
  /// error times Student's t at one sigma. Otherwise intervals of a few sigma would have too little coverage for few
  /// values.
  static Estimate from_student_t(double value, double error, double dof, std::uint64_t count);
  /// The standard error without the widening: the `error` argument of from_student_t().
  double unwidened_std_error() const;

  /// Confidence interval.
  struct Interval {
    double lo, ///< Lower bound.
        hi;    ///< Upper bound.
  };
  /// Two-sided confidence interval. Throws Error unless 0 < confidence < 1.
  Interval interval(double confidence = 0.95) const;
};

} // namespace mc
