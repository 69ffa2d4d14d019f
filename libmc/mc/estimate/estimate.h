#pragma once
/// An answer with an error bar.

#include <cstdint>

namespace mc {

/// A mean and its standard error. With `dof` degrees of freedom behind the error, (value - truth) / std_error is Student t.
struct Estimate {
  double value = 0;
  double std_error = 0;
  double dof = 0; ///< 0: normal
  std::uint64_t count = 0;

  struct Interval { double lo, hi; };
  /// Two-sided confidence interval. Throws Error unless 0 < confidence < 1.
  Interval interval(double confidence = 0.95) const;
};

} // namespace mc
