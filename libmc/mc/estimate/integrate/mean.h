#pragma once
/// Means whose error was estimated, and what two of them say of each other.

#include <optional>
#include <vector>

namespace mc::detail {

/// A mean whose variance was estimated with `dof` degrees of freedom.
struct Mean {
  double value = 0, variance = 0, dof = 0;
};
using Means = std::vector<Mean>; ///< one per output

/// Degrees of freedom behind the sum of the variances [Welch47].
double welch(const Mean& a, const Mean& b);

/// By how many standard deviations of a normal two independent means differ; nothing where both are exact.
std::optional<double> deviate(const Mean& a, const Mean& b);

} // namespace mc::detail
