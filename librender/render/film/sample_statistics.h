#pragma once
/// Statistics of the samples of a pixel.

#include <render/core/types.h>

#include <algorithm>
#include <cstdint>

namespace render {

/// Statistics of the light path contributions of a pixel; see Film::add_light_splat.
struct LightSums {
  double squares = 0;                                      ///< Sum of squared luminances.
  float largest = 0;                                       ///< Largest luminance.
  Eigen::Array3f channel_largest = Eigen::Array3f::Zero(); ///< Largest value per channel.

  /// Adds one contribution.
  void add(const Eigen::Array3d& value) {
    const auto y = static_cast<float>(luminance(value));
    squares += mc::sqr(double(y));
    largest = std::max(largest, y);
    channel_largest = channel_largest.max(value.cast<float>());
  }
  /// The sums, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(squares, largest, channel_largest); }
};

/// Sums over samples of a pixel, from which SampleStatistics follow. A sample costs no division.
struct SampleSums {
  std::uint64_t count = 0;                                                          ///< Number of samples.
  double sum = 0,                                                                   ///< Sum of luminances.
      squares = 0,                                                                  ///< Sum of squared luminances.
      largest = 0;                                                                  ///< Largest luminance.
  Eigen::Array3d channel_sums = Eigen::Array3d::Zero();                             ///< Sums per channel.
  Eigen::Array3d channel_squares = Eigen::Array3d::Zero();                          ///< Sums of squares per channel.
  Eigen::Array3d channel_largest = Eigen::Array3d::Zero();                          ///< Maxima per channel.
  Eigen::Array3d channel_smallest = Eigen::Array3d::Constant(mc::infinity<double>); ///< Minima per channel.

  /// Adds one sample.
  void add(const Eigen::Array3d& sample) {
    const double y = luminance(sample);
    ++count;
    sum += y;
    squares += y * y;
    largest = std::max(largest, y);
    channel_sums += sample;
    channel_squares += sample.square();
    channel_largest = channel_largest.max(sample);
    channel_smallest = channel_smallest.min(sample);
  }
  /// The sums, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(count, sum, squares, largest, channel_sums, channel_squares, channel_largest, channel_smallest);
  }
};

/// Spread, extremes and jumps of the samples of a pixel. Single precision, since a film keeps them for each pixel:
/// standard deviations have the range of radiance, as squares would not. In jumps and effective counts, deviations
/// below 1e-6 of the root mean square count as rounding errors of equal samples. A pixel has fewer than 2^32 samples.
struct SampleStatistics {
  std::uint32_t count = 0;                                    ///< Number of samples.
  float deviation = 0,                                        ///< Root mean squared deviation of luminance.
      largest = 0;                                            ///< Largest luminance.
  Eigen::Array3f channel_means = Eigen::Array3f::Zero();      ///< Means per channel.
  Eigen::Array3f channel_deviations = Eigen::Array3f::Zero(); ///< As `deviation`, per channel.
  Eigen::Array3f channel_largest = Eigen::Array3f::Zero();    ///< Maxima per channel.
  /// Minima per channel.
  Eigen::Array3f channel_smallest = Eigen::Array3f::Constant(mc::infinity<float>);

  /// Adds samples. Their variance and that of the earlier samples combine by Chan's formula [ChanGolubLeVeque83].
  void add(const SampleSums& samples);
  /// The statistics, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) {
    a(count, deviation, largest, channel_means, channel_deviations, channel_largest, channel_smallest);
  }

  /// Variance of the mean of independent samples, per channel; infinite for fewer than 2 samples.
  Eigen::Array3d variance_of_mean() const;

  /// Effective sample count: the sum of (y - mean)^2 over all samples, divided by that of the brightest; y is the
  /// luminance. Infinite if all samples are equal. Below 2 one sample dominates the pixel: it has too few samples of
  /// the paths that make it bright, and its error bar is unreliable.
  ///   light  : light path contributions to the pixel; they count as samples without a mean.
  ///   weight : factor of a light path contribution relative to a sample.
  double effective_sample_count(const LightSums& light = {}, double weight = 0) const;

  /// Jump J of the samples per channel: the range R for two distinct values, as at an edge; 0 for an even spread, as on
  /// a slope. J = R sqrt(clamp(3 b / 2 - 1 / 2, 0, 1)). b is the variance of the samples over that of two values at the
  /// ends of their range with the same mean [BhatiaDavis00]. But J = R if any sample is farther than three standard
  /// deviations from the mean.
  Eigen::Array3d jump() const;
};

} // namespace render
