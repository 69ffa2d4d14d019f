#pragma once
/// Constant-time sampling of many outcomes.

#include <mc/table/concept.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Walker's alias table in Vose's construction: one look-up for any number of outcomes. The map is not monotone in u,
/// so it loses the stratification of u; prefer TableDist1D for low-discrepancy points.
///   sample_index : bin floor(u n) gives its own outcome below a threshold and its alias above.
///   pmf          : w_i / sum w.
///   error        : the sampled probability of i differs from pmf(i) by at most 2^-52 for each bin that points to i.
///   throws       : Error for no weights, a weight that is not finite and >= 0, or all weights 0.
///   Source       : [Walker74, Vose91].
class AliasTable {
 public:
  using Scalar = double;

  /// Builds the table for the given weights in O(n).
  explicit AliasTable(std::span<const double> weights);

  DiscreteSample<double> sample_index(double u) const {
    const double scaled =
        u * static_cast<double>(static_cast<std::int64_t>(bins_.size())); // rounds to less than size()
    const auto i = static_cast<std::int64_t>(scaled);
    const Bin& bin = bins_[static_cast<std::size_t>(i)];
    const double v = scaled - static_cast<double>(i);
    // Look-ups by 0 or 1 replace a branch, which would often be mispredicted.
    const bool other = !(v < bin.threshold);
    const double from[] = {0, bin.threshold}, width[] = {bin.threshold, 1 - bin.threshold};
    const std::size_t outcome[] = {static_cast<std::size_t>(i), bin.alias};
    return {outcome[other], bins_[outcome[other]].pmf, below_one((v - from[other]) / width[other])};
  }
  double pmf(std::size_t i) const { return bins_[i].pmf; }
  std::size_t size() const { return bins_.size(); }

 private:
  struct Bin {
    double threshold;
    double pmf; // probability of the outcome with the index of this bin
    std::uint32_t alias;
  };
  static double below_one(double v) { return v < 1 ? v : one_minus_epsilon<double>; }

  std::vector<Bin> bins_;
};

} // namespace mc
