#pragma once
/// Correlations of the errors of several outputs.

#include <mc/estimate/integrate/error_bar.h>

#include <vector>

namespace mc::detail {

/// Correlation matrix of the errors of the outputs, row by row, with 1 on the diagonal.
using Correlations = std::vector<double>;

/// Correlations of means[output][replicate]; 0 for outputs with equal replicates.
Correlations correlations(const std::vector<std::vector<double>>& means);

/// Correlations of combine_independent(a, b, share) for independent a and b.
Correlations combine_independent(const Correlations& of_a, const Means& a, const Correlations& of_b, const Means& b,
                                 double share);

} // namespace mc::detail
