#pragma once
/// Constant-time sampling of many outcomes.

#include <mc/table/concept.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Walker's alias table in Vose's construction: one lookup whatever the number of outcomes. Unlike a CDF it is not monotone in
/// u, so stratification of u is lost; prefer TableDist1D for low-discrepancy points.
///   sample_index : the bin floor(u n) keeps its own outcome below a threshold and its alias above
///   pmf          : w_i / sum w
///   error        : the sampled probability of i differs from pmf(i) by at most 2^-52 per bin that points to it
///   throws       : Error for no weights, a weight that is not finite and >= 0, or all weights 0
///   Source       : [Walker74, Vose91]
class AliasTable {
 public:
  using Scalar = double;

  explicit AliasTable(std::span<const double> weights);

  DiscreteSample<double> sample_index(double u) const {
    const double scaled = u * static_cast<double>(bins_.size());
    const auto i = static_cast<std::size_t>(scaled) < bins_.size() ? static_cast<std::size_t>(scaled) : bins_.size() - 1;
    const Bin& bin = bins_[i];
    const double v = scaled - static_cast<double>(i);
    if (v < bin.threshold) return {i, pmf_[i], below_one(v / bin.threshold)};
    return {bin.alias, pmf_[bin.alias], below_one((v - bin.threshold) / (1 - bin.threshold))};
  }
  double pmf(std::size_t i) const { return pmf_[i]; }
  std::size_t size() const { return bins_.size(); }

 private:
  struct Bin { double threshold; std::uint32_t alias; };
  static double below_one(double v) { return v < 1 ? v : one_minus_epsilon<double>; }

  std::vector<Bin> bins_;
  std::vector<double> pmf_;
};

} // namespace mc
