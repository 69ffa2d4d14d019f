#pragma once
/// How the errors of several outputs go together.

#include <mc/estimate/integrate/mean.h>

#include <vector>

namespace mc::detail {

/// Correlations of the outputs' errors, row by row: 1 on the diagonal.
using Correlations = std::vector<double>;

/// Those of means[output][replicate]; 0 beside an output whose replicates are equal.
Correlations correlations(const std::vector<std::vector<double>>& means);

/// Those of combine_independent(a, b, share), where a and b are independent.
Correlations combine_independent(const Correlations& of_a, const Means& a, const Correlations& of_b, const Means& b,
                                 double share);

} // namespace mc::detail
