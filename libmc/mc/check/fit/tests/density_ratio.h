#pragma once
/// Samples by the density that is claimed where they lie: a sampler that does not follow what is finer than any cell
/// puts too many of its samples where the density is low.

#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace mc {

/// Counts samples, and what is expected of them, by the ratio of the claimed density to that of the pilot around, in
/// steps of a quarter of an octave.
class DensityRatioTest {
 public:
  /// share : what a random point at its place stands for
  void add_sample(double ratio, double weight, double share) { levels_[index(ratio)].add_sample(weight, share); }
  /// A random point that stands for a share of the expected samples; weight : what a sample at its place counts.
  void add_expected(double ratio, double share, double weight) { levels_[index(ratio)].add_expected(share, weight); }

  /// A chi-square over the levels that say enough, the others joined to them, given the sum of the samples; see
  /// weighted_counts.h.
  Check test(double share, double alpha) const;

 private:
  static constexpr std::int64_t count = 128, middle = 1023 * 4; ///< 2^-16 to 2^16
  static std::size_t index(double ratio) {
    if (!(ratio > 0)) return 0;
    const std::int64_t level = (std::bit_cast<std::int64_t>(ratio) >> 50) - middle + count / 2;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(level, 0, count - 1));
  }
  std::array<WeightedCounts, count> levels_{};
};

} // namespace mc
