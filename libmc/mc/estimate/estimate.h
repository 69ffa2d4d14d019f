#pragma once
/// An answer with an error bar.

#include <cstdint>

namespace mc {

/// A value with its error bar: value +- std_error covers the truth with the probability of one sigma, 68.27 %, and
/// `interval` with any other, however few values the error was estimated from, if their mean is normal.
struct Estimate {
  double value = 0;
  /// Half the width of the 68.27 % interval: the standard error of a mean, widened for its own uncertainty.
  double std_error = 0;
  double dof = 0; ///< degrees of freedom behind std_error; 0: it is exact
  std::uint64_t count = 0;

  /// From the standard error of a mean that was itself estimated with `dof` degrees of freedom: std_error is the error
  /// times Student's t at one sigma, 1.02 times for 23 degrees of freedom and 1.84 times for 1. Without it, 2 sigma of
  /// 24 values would cover 94.3 % instead of 94.7 %, and of 4 values 86 % instead of 90 %.
  static Estimate from_student_t(double value, double error, double dof, std::uint64_t count);
  /// The `error` again.
  double unwidened_std_error() const;

  struct Interval {
    double lo, hi;
  };
  /// Two-sided confidence interval. Throws Error unless 0 < confidence < 1.
  Interval interval(double confidence = 0.95) const;
};

} // namespace mc
