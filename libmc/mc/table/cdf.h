#pragma once
/// The cumulative table behind the tabulated distributions.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Look-up in a cumulative table stored elsewhere; see Cdf.
struct CdfView {
  static constexpr std::size_t window = 3; ///< Number of outcomes compared without a branch.

  const double* cumulative;   ///< ends(n) entries: n + 1 from 0 to 1, then padding above 1 that a look-up may read.
  const std::uint32_t* guide; ///< cells(n) + 1 entries: the first outcome for the least u with u cells(n) >= k.
  std::uint32_t n;            ///< Number of outcomes.

  /// Size of `cumulative` for n outcomes.
  static constexpr std::size_t ends(std::size_t n) { return n + 1 + window; }
  /// Number of guide cells for n outcomes. One guide entry covers two outcomes: half the memory saves more time than
  /// the extra comparison costs.
  static constexpr std::uint32_t cells(std::size_t n) { return static_cast<std::uint32_t>((n + 1) / 2); }

  /// Lower end of the interval of outcome i; cdf(size()) = 1.
  double cdf(std::size_t i) const { return cumulative[i]; }
  /// Probability of outcome i.
  double pmf(std::size_t i) const { return cumulative[i + 1] - cumulative[i]; }
  /// Number of outcomes.
  std::size_t size() const { return n; }

  /// Outcome with an interval that contains u in [0,1): the first outcome with an upper end above u.
  std::size_t find(double u) const {
    if (n <= window) return passed(0, u); // a shorter chain of dependent steps than the guide
    const auto cell = static_cast<std::size_t>(static_cast<std::int64_t>(u * cells(n)));
    const std::size_t lo = guide[cell], more = passed(lo, u);
    return more < window ? lo + more : find_beyond(lo + window, cell, u);
  }

 private:
  // Number of outcomes, among the `window` from lo on, that end at or below u. Counts without a branch to mispredict;
  // most cells have no more candidates.
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

/// Cumulative distribution over n outcomes with constant-time look-up.
///   pmf    : the length cdf(i + 1) - cdf(i) of the interval of outcome i. Claimed and sampled probability are equal by
///            construction. An outcome has an interval if and only if its weight is positive.
///   ends   : multiples of 2^-53. Exactly the share pmf(i) of the 2^53 values of uniform<double> falls on outcome i.
///   error  : |pmf(i) - w_i / sum w| <= 2^-51 if no weight is below 2^-53 of the sum; else up to n 2^-53.
///   cost   : O(1) expected for any n and weights. A guide table starts the search [ChenAsau74].
///   throws : Error for no weights, a weight that is not finite and >= 0, or all weights 0.
class Cdf {
 public:
  /// Builds the table for the given weights.
  explicit Cdf(std::span<const double> weights);

  /// Fills the arrays of a CdfView for the given weights.
  static void fill(std::span<const double> weights, double* cumulative, std::uint32_t* guide);

  /// Number of outcomes.
  std::size_t size() const { return cumulative_.size() - CdfView::ends(0); }
  /// Lower end of the interval of outcome i; cdf(size()) = 1.
  double cdf(std::size_t i) const { return cumulative_[i]; }
  /// Probability of outcome i.
  double pmf(std::size_t i) const { return view().pmf(i); }
  /// Outcome with an interval that contains u in [0,1).
  std::size_t find(double u) const { return view().find(u); }
  /// View of this table, valid while the table exists.
  CdfView view() const { return {cumulative_.data(), guide_.data(), static_cast<std::uint32_t>(size())}; }

 private:
  std::vector<double> cumulative_;
  std::vector<std::uint32_t> guide_;
};

} // namespace mc
