#pragma once
/// Control variates: variance reduction by similar integrands with known integrals.

#include <mc/estimate/estimate.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Joint moments of an integrand f and controls g_1 ... g_k with known means; mergeable.
///   estimate(beta) : Mean of f - sum_j beta_j (g_j - means[j]). Unbiased if beta does not depend on these samples.
///   coefficients() : The beta of least variance for these samples, Cov(g)^-1 Cov(g, f). For linearly dependent
///                    controls, the shortest solution in units of their standard deviations. Apply it to other samples,
///                    because it biases the estimate of its own.
///   error          : No cancellation, by Welford's update of the covariance.
///   throws         : Error unless there is a control and all means are finite. estimate() and coefficients() throw
///                    Error if a value was not finite, with the index of the first, or if there are fewer than two
///                    values.
///   Source         : [LavenbergWelch81].
class ControlVariates {
 public:
  /// Controls with the means `means`.
  explicit ControlVariates(std::span<const double> means);

  /// Adds a sample: the value of f and the values of all controls.
  void add(double f, std::span<const double> g, std::uint64_t index = 0);
  /// Adds the samples of `other`. Throws Error unless it has the same means.
  void merge(const ControlVariates& other);

  /// Number of finite samples.
  std::uint64_t count() const { return count_; }
  /// Number of samples with a non-finite value.
  std::uint64_t non_finite_count() const { return non_finite_; }
  /// The known means of the controls.
  std::span<const double> means() const { return means_; }
  /// Coefficients of least variance.
  std::vector<double> coefficients() const;
  /// Estimate with coefficients `beta`.
  Estimate estimate(std::span<const double> beta) const;
  /// Estimate without controls, beta = 0.
  Estimate without_controls() const { return estimate(std::vector<double>(means_.size())); }

 private:
  void require_enough() const;

  std::vector<double> means_, mean_; ///< known means of g; sample means of (f, g - means_)
  std::vector<double> scatter_;      ///< Sums of products of deviations of (f, g): a symmetric matrix, row by row.
  std::uint64_t count_ = 0, non_finite_ = 0, first_non_finite_ = 0;
};

/// Estimate from both halves of the samples, each with the coefficients of the other. Unbiased, and needs no separate
/// pilot samples.
///   error  : The errors of the halves are uncorrelated up to a relative 1 / n, so their squares add.
///   throws : The errors of estimate(), and Error unless both halves have the same means.
Estimate cross_fitted_estimate(const ControlVariates& a, const ControlVariates& b);

} // namespace mc
