#pragma once
/// Pearson's chi-square test, its tails and its power.

#include <cstdint>
#include <vector>

namespace mc {

/// P(X > statistic) for X chi-square with `dof` degrees of freedom; 1 for dof = 0.
double chi_square_tail(double statistic, double dof);

/// The x with P(X > x) = p, p in (0, 1), for X chi-square with `dof` > 0 degrees of freedom.
double chi_square_quantile(double p, double dof);

/// P(|Z| > |z|) for a standard normal Z.
double normal_tail(double z);

/// The z with P(|Z| > z) = p for a standard normal Z.
double normal_quantile(double p);

/// Noncentrality at which a chi-square test at this level rejects with probability `power`.
///   error : At most 2 %. Exact up to 20 degrees of freedom, beyond that by Patnaik's approximation [Patnaik49].
double chi_square_noncentrality(double dof, double level, double power);

/// Result of a chi-square test.
struct ChiSquare {
  double statistic = 0; ///< Sum of (observed - expected)^2 / expected over the pooled cells.
  double dof = 0;       ///< Number of cells after pooling, minus 1.
  double p = 1;         ///< P(X > statistic).
  /// Detected effect size: relative error of random sign in every expected count that a test at `alpha` detects with
  /// probability .99.
  double detectable = 0;
};

/// Tests counts against expected counts with the same total.
///   pooling : Joins neighbouring cells until each expects at least `least` counts. Drops nothing.
///   zeros   : A count in a cell that expects exactly 0 gives p = 0.
///   throws  : Error if the sizes differ, there are no counts, an expected count is negative or not finite, or the
///             totals differ by more than 1e-6 of the total.
///   Source  : [Pearson1900].
ChiSquare chi_square(const std::vector<std::uint64_t>& observed, const std::vector<double>& expected,
                     double alpha = 0.01, double least = 5);

} // namespace mc
