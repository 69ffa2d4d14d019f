#pragma once
/// Student's test of a mean against a known value, and Welch's degrees of freedom of sums and differences.

#include <mc/core/types.h>

#include <algorithm>

namespace mc {

struct TTest {
  double t = 0;          ///< (mean - value) / standard error
  double p = 1;          ///< two-sided
  double detectable = 0; ///< smallest |E[x] - value| that the test would have caught at `alpha` with probability .99
};

/// Tests whether a mean with a standard error that was estimated with `dof` degrees of freedom is `value`.
///   error  : exact for normal values; else as good as the central limit theorem
///   throws : Error unless `value` is finite and 0 < alpha < 1
///   Source : [Student08]
TTest t_test(double mean, double error, double dof, double value, double alpha);

/// The same for mc::Moments. Throws Error when a value was not finite, or there are fewer than two.
template <class M>
requires requires(const M& m) { m.estimate().dof; }
TTest t_test(const M& moments, double value, double alpha = 0.01) {
  const auto e = moments.estimate();
  return t_test(e.value, moments.std_error(), e.dof, value, alpha);
}

/// Degrees of freedom behind the sum of two variances, each estimated with its own.
///   error : that of Satterthwaite's approximation; exact where one variance is 0. dof_a + dof_b where both are
///   Source : [Welch47]
double welch_dof(double variance_a, double dof_a, double variance_b, double dof_b);

/// A sum of many variances, and the degrees of freedom behind it: few where few of them are most of it.
struct VarianceSum {
  double value = 0, squares = 0;

  /// Of variances that share their noise, so that `correlated_terms` of them say no more than one, each counts so much less.
  void add(double variance, double dof, double correlated_terms = 1) {
    value += variance;
    squares += correlated_terms * variance * variance / (dof + 2);
  }
  /// By Satterthwaite's formula, less the bias that it has because estimates stand for the variances: their squares,
  /// of d degrees of freedom each, are (d + 2) / d times too large in the mean. Exact for one term; never below 1, and
  /// infinite where the sum is 0.
  ///   Source : [Welch47]
  double dof() const { return squares > 0 ? std::max(value * value / squares - 2, 1.0) : infinity<double>; }
};

/// P(|T| > |t|) for Student's T with `dof` degrees of freedom.
double student_tail(double t, double dof);

/// t with P(|T| > t) = p, 0 < p <= 1.
double student_quantile(double p, double dof);

} // namespace mc
