#pragma once
/// The Kolmogorov-Smirnov test.

#include <functional>
#include <vector>

namespace mc {

/// P(sqrt(n) D > lambda) in the limit of large n, for the two-sided statistic D = sup |F_n - F|.
///   error : 1e-15 for the limit. See ks_test() for finite n.
double kolmogorov_tail(double lambda);

/// Result of a Kolmogorov-Smirnov test.
struct KsTest {
  double d = 0;        ///< Statistic sup |F_n - F|.
  double location = 0; ///< Sample at which the supremum is reached.
  double p = 1;        ///< P(D > d).
};

/// Tests samples against a continuous distribution function.
///   error  : p is within 0.004 for n >= 20, by Stephens' correction lambda = D (sqrt n + 0.12 + 0.11 / sqrt n).
///   throws : Error if there are no samples, or one is not finite.
///   Source : [Kolmogorov33], [Stephens70].
KsTest ks_test(std::vector<double> samples, const std::function<double(double)>& cdf);

} // namespace mc
