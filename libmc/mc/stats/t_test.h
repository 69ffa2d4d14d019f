#pragma once
/// Student's t test of a mean, and Welch's degrees of freedom of sums of variances.

#include <mc/core/types.h>

#include <algorithm>

namespace mc {

/// Result of a t test.
struct TTest {
  double t = 0;          ///< Statistic (mean - value) / standard error.
  double p = 1;          ///< Two-sided p-value.
  double detectable = 0; ///< Smallest |E[x] - value| that the test at `alpha` detects with probability .99.
};

/// Tests whether a mean equals `value`. `error` is its standard error, estimated with `dof` degrees of freedom.
///   error  : Exact for normal values, otherwise as accurate as the central limit theorem.
///   throws : Error unless `value` is finite and 0 < alpha < 1.
///   Source : [Student08].
TTest t_test(double mean, double error, double dof, double value, double alpha);

/// Same test for the mean of an mc::Moments. Throws Error if a value was not finite, or if there are fewer than two
/// values.
template <class M>
requires requires(const M& m) { m.estimate().dof; }
TTest t_test(const M& moments, double value, double alpha = 0.01) {
  const auto e = moments.estimate();
  return t_test(e.value, moments.std_error(), e.dof, value, alpha);
}

/// Degrees of freedom of the sum of two variances, each estimated with its own degrees of freedom.
///   error  : Error of Satterthwaite's approximation. Exact if one variance is 0. Returns dof_a + dof_b if both are 0.
///   Source : [Welch47].
double welch_dof(double variance_a, double dof_a, double variance_b, double dof_b);

/// Sum of many variances and its effective degrees of freedom, which are few if a few terms dominate.
struct VarianceSum {
  double value = 0, ///< Sum of the variances.
      squares = 0;  ///< Sum of squares behind dof().

  /// Adds a variance estimated with `dof` degrees of freedom. If `correlated_terms` terms share the same noise, each
  /// contributes fewer degrees of freedom, so that together they contribute as much as one term.
  void add(double variance, double dof, double correlated_terms = 1) {
    value += variance;
    squares += correlated_terms * variance * variance / (dof + 2);
  }
  /// Effective degrees of freedom by Satterthwaite's formula, corrected for bias. A squared variance estimate of d
  /// degrees of freedom is (d + 2) / d times too large on average. Exact for one term, at least 1, and infinite if the
  /// sum is 0.
  ///   Source : [Welch47].
  double dof() const { return squares > 0 ? std::max(value * value / squares - 2, 1.0) : infinity<double>; }
};

/// P(|T| > |t|) for Student's T with `dof` degrees of freedom.
double student_tail(double t, double dof);

/// The t with P(|T| > t) = p, 0 < p <= 1.
double student_quantile(double p, double dof);

} // namespace mc
