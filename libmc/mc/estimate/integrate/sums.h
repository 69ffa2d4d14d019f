#pragma once
/// Sums that the tasks of a run accumulate.

#include <mc/estimate/diagnostics/sampled_values.h>
#include <mc/estimate/moments.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mc::detail {

/// Moments of values of any size, in units of a power of two, so that squares of tiny or huge values do not underflow
/// or overflow. Values between 2^-256 and 2^256 are added unscaled.
class ScaledMoments {
 public:
  /// Adds a block of values with indices from `first` on, and modifies them. `largest` is an upper bound of their
  /// absolute values.
  void add(std::span<double> values, std::uint64_t first, double largest);
  /// Adds the values of other moments.
  void merge(const ScaledMoments& other);

  /// Mean of the values.
  double mean() const;
  /// Standard error of the mean.
  double std_error() const;
  /// Moments in units of the power of two.
  const Moments& moments() const { return moments_; }
  /// The moments, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(moments_, exponent_); }

 private:
  void rescale(int exponent);
  /// Whether all values are 0, or there are none.
  bool only_zeros() const { return moments_.mean() == 0 && moments_.variance() == 0; }

  Moments moments_;
  int exponent_ = 0;
};

/// Values of one output that were infinite, and count as 0.
struct InfiniteValues {
  std::uint64_t count = 0; ///< Number of points.
  double volume = 0;       ///< Volume that the points represent, in units of one point.

  /// Adds the points of another sum.
  void merge(const InfiniteValues& other) {
    count += other.count;
    volume += other.volume;
  }
  /// The values, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(count, volume); }
};

/// Moments and extreme values of every output. Optionally also the moments of batches of values.
struct Sums {
  /// Number of batches.
  static constexpr std::size_t batch_count = 32;

  std::vector<ScaledMoments> outputs;               ///< Moments of each output.
  std::vector<SampledValues> sampled;               ///< All values of each output.
  double jacobians = 0;                             ///< Sum of the Jacobians of the axis warp; 0 without one.
  std::vector<InfiniteValues> infinite = {};        ///< Infinite values of each output.
  std::vector<ScaledMoments> batches = {};          ///< batch_count moments for each output.
  std::optional<std::uint64_t> first_infinite = {}; ///< Index of the first point with an infinite value.

  /// Replaces infinite values by 0 and counts them. Points have indices from `first` on and represent `volumes` of the
  /// cube.
  void zero_infinite_values(std::span<double> all_values, std::span<const double> volumes, std::uint64_t first);

  /// Adds values of an output with indices from `first` on: 32 to a batch, cyclically.
  void add_to_batches(std::size_t output, std::span<const double> added, std::uint64_t first, double largest);
  /// Appends the values of other sums.
  void merge(Sums other);
  /// The sums, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(outputs, sampled, jacobians, infinite, batches, first_infinite);
  }
  /// Mean of an output: with an axis warp over that of the Jacobians, which is 1 but for the error of the points.
  double mean(std::size_t output) const {
    const double count = static_cast<double>(outputs[output].moments().count());
    return outputs[output].mean() / (jacobians > 0 ? jacobians / count : 1.0);
  }
};

} // namespace mc::detail
