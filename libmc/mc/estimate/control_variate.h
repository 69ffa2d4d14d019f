#pragma once
/// Control variates: what is known of a similar integrand takes noise off the unknown one.

#include <mc/estimate/estimate.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Joint moments of an integrand f and controls g_1 ... g_k whose means are known, mergeable.
///   estimate(beta) : mean of f - sum_j beta_j (g_j - means[j]): unbiased when beta does not depend on these samples
///   coefficients() : the beta of least variance, Cov(g)^-1 Cov(g, f), of these samples; where controls depend on each
///                    other linearly, the shortest in units of their standard deviations. For use on other samples: on
///                    its own it would bias
///   error          : no cancellation: Welford's update of the covariance
///   throws         : Error unless there is a control and all means are finite; estimate() and coefficients() when a
///                    value was not finite, with the index of the first, or there are fewer than two
///   Source         : [LavenbergWelch81]
class ControlVariates {
 public:
  explicit ControlVariates(std::span<const double> means);

  void add(double f, std::span<const double> g, std::uint64_t index = 0);
  /// Throws Error unless the other has the same means.
  void merge(const ControlVariates& other);

  std::uint64_t count() const { return count_; }
  std::uint64_t non_finite_count() const { return non_finite_; }
  std::vector<double> coefficients() const;
  Estimate estimate(std::span<const double> beta) const;
  /// Without controls, beta = 0.
  Estimate without_controls() const { return estimate(std::vector<double>(means_.size())); }

 private:
  void require_enough() const;

  std::vector<double> means_, mean_; ///< known means of g; sample means of (f, g - means_)
  std::vector<double> scatter_;      ///< sums of products of deviations of (f, g): the symmetric matrix, row by row
  std::uint64_t count_ = 0, non_finite_ = 0, first_non_finite_ = 0;
};

/// Both halves of the samples at once: each with the coefficients of the other, so unbiased, and no pilot is thrown
/// away.
///   error  : the errors of the halves are uncorrelated up to a relative 1 / n, so they add as squares
///   throws : Error as estimate(), and unless both know the same means
Estimate cross_fitted_estimate(const ControlVariates& a, const ControlVariates& b);

} // namespace mc
