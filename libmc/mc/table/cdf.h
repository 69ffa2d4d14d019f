#pragma once
/// The cumulative table behind the tabulated distributions.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Cumulative distribution over n outcomes with constant-time lookup.
///   The probability of outcome i IS the length of its interval, cdf(i + 1) - cdf(i), so what is sampled and what is claimed
///   cannot disagree. An outcome of positive weight has a positive interval; one of weight 0 has none.
///   Ends are multiples of 2^-53: of the 2^53 values of uniform<double>, exactly the share pmf(i) falls on outcome i.
///   error  : |pmf(i) - w_i / sum w| <= 2^-52 if no weight is below 2^-53 of the sum; else up to n 2^-53
///   cost   : O(1) expected whatever n and the weights: a guide table of n entries starts the search [ChenAsau74]
///   throws : Error for no weights, a weight that is not finite and >= 0, or all weights 0
class Cdf {
 public:
  explicit Cdf(std::span<const double> weights);

  std::size_t size() const { return cumulative_.size() - 1; }
  /// Lower end of the interval of outcome i; cdf(size()) = 1.
  double cdf(std::size_t i) const { return cumulative_[i]; }
  double pmf(std::size_t i) const { return cumulative_[i + 1] - cumulative_[i]; }
  double sum() const { return sum_; } ///< of the weights, may be infinite when they overflow

  /// The outcome whose interval holds u in [0,1).
  std::size_t find(double u) const {
    const std::size_t n = size();
    const auto cell = static_cast<std::size_t>(u * static_cast<double>(n));
    std::size_t lo = guide_[cell], hi = guide_[cell + 1];
    // First outcome whose upper end exceeds u; most cells hold one or two candidates, so walk before halving.
    for (int step = 0; lo < hi; ++step) {
      const std::size_t middle = step < 3 ? lo : lo + (hi - lo) / 2;
      if (cumulative_[middle + 1] > u) hi = middle;
      else lo = middle + 1;
    }
    return lo;
  }

 private:
  std::vector<double> cumulative_;    ///< n + 1 entries, from 0 to 1
  std::vector<std::uint32_t> guide_;  ///< n + 1 entries: the first outcome whose upper end exceeds k / n
  double sum_ = 0;
};

} // namespace mc
