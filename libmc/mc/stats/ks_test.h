#pragma once
/// The test of Kolmogorov and Smirnov.

#include <functional>
#include <vector>

namespace mc {

/// P(sqrt(n) D > lambda) in the limit of many samples, for the two-sided statistic D = sup |F_n - F|.
///   error : 1e-15; at finite n, see ks_test
double kolmogorov_tail(double lambda);

struct KsTest {
  double d = 0;        ///< sup |F_n - F|
  double location = 0; ///< where it is reached
  double p = 1;
};

/// Compares samples with a continuous distribution function.
///   error  : p within 0.004 absolute for n >= 20, by Stephens' correction lambda = D (sqrt n + 0.12 + 0.11 / sqrt n)
///   throws : Error when there are no samples, or one is not finite
///   Source : [Kolmogorov33], [Stephens70]
KsTest ks_test(std::vector<double> samples, const std::function<double(double)>& cdf);

} // namespace mc
