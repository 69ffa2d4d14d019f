#pragma once
/// Counts of samples by the claimed density at their positions. If samples do not follow structure finer than the
/// cells, too many of them lie where the density is low.

#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace mc {

/// Counts observed and expected samples by the ratio of the claimed density to the pilot's density nearby, in steps of
/// a quarter octave.
class DensityRatioTest {
 public:
  /// Adds a sample.
  ///   share : the share that a random point at its position represents.
  void add_sample(double ratio, double weight, double share) { levels_[index(ratio)].add_sample(weight, share); }
  /// Adds a random point that represents a share of the expected samples.
  ///   weight : the weight of a sample at its position.
  void add_expected(double ratio, double share, double weight) { levels_[index(ratio)].add_expected(share, weight); }

  /// Returns a chi-square test over the levels, given the sum of the samples. Levels with too little information are
  /// pooled with their neighbours; see weighted_counts.h.
  Check test(double share, double alpha) const;

 private:
  static constexpr std::int64_t count = 128, middle = 1023 * 4; ///< range of ratios: 2^-16 to 2^16
  static std::size_t index(double ratio) {
    if (!(ratio > 0)) return 0;
    const std::int64_t level = (std::bit_cast<std::int64_t>(ratio) >> 50) - middle + count / 2;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(level, 0, count - 1));
  }
  std::array<WeightedCounts, count> levels_{};
};

} // namespace mc
