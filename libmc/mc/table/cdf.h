#pragma once
/// The cumulative table behind the tabulated distributions.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Look-up in a cumulative table that lives elsewhere; see Cdf.
struct CdfView {
  static constexpr std::size_t window = 3; ///< outcomes that are looked at without a jump

  const double* cumulative;   ///< ends(n) entries: n + 1 from 0 to 1, then padding above 1 that a look-up may read
  const std::uint32_t* guide; ///< cells(n) + 1 entries: the first outcome for the least u with u cells(n) >= k
  std::uint32_t n;

  static constexpr std::size_t ends(std::size_t n) { return n + 1 + window; }
  /// One guide for two outcomes: half the memory costs less than one more comparison.
  static constexpr std::uint32_t cells(std::size_t n) { return static_cast<std::uint32_t>((n + 1) / 2); }

  double cdf(std::size_t i) const { return cumulative[i]; }
  double pmf(std::size_t i) const { return cumulative[i + 1] - cumulative[i]; }
  std::size_t size() const { return n; }

  /// The outcome whose interval holds u in [0,1): the first whose upper end exceeds u.
  std::size_t find(double u) const {
    if (n <= window) return passed(0, u); // a shorter chain of dependent steps than by the guide
    const auto cell = static_cast<std::size_t>(static_cast<std::int64_t>(u * cells(n)));
    const std::size_t lo = guide[cell], more = passed(lo, u);
    return more < window ? lo + more : find_beyond(lo + window, cell, u);
  }

 private:
  // How many of the outcomes from lo on end at u or below. Most cells hold no more candidates than these: counted,
  // without a jump to mispredict.
  std::size_t passed(std::size_t lo, double u) const {
    std::size_t count = 0;
    for (std::size_t k = 1; k <= window; ++k) count += cumulative[lo + k] <= u;
    return count;
  }
  std::size_t find_beyond(std::size_t lo, std::size_t cell, double u) const {
    std::size_t hi = guide[cell + 1];
    for (int step = 0; lo < hi; ++step) {
      const std::size_t middle = step < 2 ? lo : lo + (hi - lo) / 2;
      if (cumulative[middle + 1] > u) hi = middle;
      else lo = middle + 1;
    }
    return lo;
  }
};

/// Cumulative distribution over n outcomes with constant-time lookup.
///   The probability of outcome i IS the length of its interval, cdf(i + 1) - cdf(i), so what is sampled and what is
///   claimed cannot disagree. An outcome of positive weight has a positive interval; one of weight 0 has none.
///   Ends are multiples of 2^-53: of the 2^53 values of uniform<double>, exactly the share pmf(i) falls on outcome i.
///   error  : |pmf(i) - w_i / sum w| <= 2^-51 if no weight is below 2^-53 of the sum; else up to n 2^-53
///   cost   : O(1) expected whatever n and the weights: a guide table starts the search [ChenAsau74]
///   throws : Error for no weights, a weight that is not finite and >= 0, or all weights 0
class Cdf {
 public:
  explicit Cdf(std::span<const double> weights);

  /// Fills the arrays of a CdfView for n weights.
  static void fill(std::span<const double> weights, double* cumulative, std::uint32_t* guide);

  std::size_t size() const { return cumulative_.size() - CdfView::ends(0); }
  /// Lower end of the interval of outcome i; cdf(size()) = 1.
  double cdf(std::size_t i) const { return cumulative_[i]; }
  double pmf(std::size_t i) const { return view().pmf(i); }
  /// The outcome whose interval holds u in [0,1).
  std::size_t find(double u) const { return view().find(u); }
  CdfView view() const { return {cumulative_.data(), guide_.data(), static_cast<std::uint32_t>(size())}; }

 private:
  std::vector<double> cumulative_;
  std::vector<std::uint32_t> guide_;
};

} // namespace mc
