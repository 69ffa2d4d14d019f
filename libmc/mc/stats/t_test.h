#pragma once
/// Student's test of a mean against a known value.

#include <mc/estimate/moments.h>

namespace mc {

struct TTest {
  double t = 0;          ///< (mean - value) / standard error
  double p = 1;          ///< two-sided
  double detectable = 0; ///< smallest |E[x] - value| that the test would have caught at `alpha` with probability .99
};

/// Tests whether the mean of the values is `value`.
///   error  : exact for normal values; else as good as the central limit theorem
///   throws : Error when a value was not finite, or there are fewer than two; unless `value` is finite and 0 < alpha <
///            1
///   Source : [Student08]
TTest t_test(const Moments& moments, double value, double alpha = 0.01);

} // namespace mc
