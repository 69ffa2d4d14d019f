#pragma once
/// Pearson's chi-square, its tails and its power.

#include <cstdint>
#include <vector>

namespace mc {

/// P(X > statistic) for X chi-square with `dof` degrees of freedom; 1 for dof = 0.
double chi_square_tail(double statistic, double dof);

/// x with P(X > x) = p, in (0, 1), for X chi-square with `dof` > 0 degrees of freedom.
double chi_square_quantile(double p, double dof);

/// P(|Z| > |z|) for a standard normal Z.
double normal_tail(double z);

/// z with P(|Z| > z) = p.
double normal_quantile(double p);

/// The noncentrality at which a chi-square test of this level rejects with probability `power`.
///   error : 2 %; exact up to 20 degrees of freedom, beyond by Patnaik's approximation [Patnaik49]
double chi_square_noncentrality(double dof, double level, double power);

struct ChiSquare {
  double statistic = 0;
  double dof = 0; ///< cells after pooling - 1
  double p = 1;
  double detectable =
      0; ///< relative error of every expected count, of random sign, caught at `alpha` with probability .99
};

/// Compares counts with expected counts that add up to the same total.
///   pooling : neighbours are joined until each expects at least `least`; nothing is dropped
///   zeros   : a count where exactly 0 is expected makes p = 0
///   throws  : Error when the sizes differ, there are no counts, an expected one is negative or not finite, or the
///             totals differ by more than 1e-6 of the total
///   Source  : [Pearson1900]
ChiSquare chi_square(const std::vector<std::uint64_t>& observed, const std::vector<double>& expected,
                     double alpha = 0.01, double least = 5);

} // namespace mc
