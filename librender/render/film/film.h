#pragma once
/// Where samples become an image with an error bar.

#include <render/film/image.h>

#include <algorithm>
#include <cstdint>

namespace render {

/// The first sample that was not finite: enough to trace it again.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t pass = 0, index = 0;
};

/// Luminances of a pixel's samples: enough to see whether one of them decides. mc::Moments with the largest beside them
/// would take 48 bytes a pixel for these 32, and a division a sample.
struct SampleSums {
  std::uint64_t count = 0;
  double sum = 0, squares = 0, largest = 0;

  void add(double y) {
    ++count;
    sum += y;
    squares += y * y;
    largest = std::max(largest, y);
  }
  void merge(const SampleSums& other);
  /// Whether the largest carries over half of the squared deviations from the mean: then there were too few samples of
  /// what makes the pixel bright, and its error bar is not known yet.
  bool is_undecided() const;
};

/// What a pixel is, as far as its samples tell.
struct PixelEstimate {
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  Eigen::Array3d variance = Eigen::Array3d::Zero(); ///< of the mean
  std::uint64_t samples = 0;
  int sets = 0; ///< that have samples; fewer than two: the variance is not known
};

/// Over what the errors of pixels are averaged.
enum class ErrorOf {
  picture, ///< all pixels
  worst    ///< the 16x16 block where they are largest; blocks at the right and lower edge may be smaller
};

/// Sums of the samples of every pixel, apart by the independent point sets that they come from: a pixel is the mean of
/// its samples, and how its sets differ tells how far it may be off. Four sets take 112 bytes a pixel, of 152 in all;
/// mc::Moments of each set and channel would take 480, of 536.
class Film {
 public:
  /// throws : Error for a non-positive size or number of sets
  Film(int width, int height, int sets);

  int width() const { return width_; }
  int height() const { return height_; }
  int sets() const { return sets_; }

  /// Adds the sum of `count` samples of one of the pixel's point sets. Pixels may be written by different threads; one
  /// pixel by one at a time.
  void add(int x, int y, int set, const Eigen::Array3d& sum, std::uint32_t count);

  /// Tells of the samples behind the sums, and of the rays that they took.
  void note(int x, int y, const SampleSums& samples, std::uint64_t rays);

  /// The mean of the pixel's samples. Sets count by their number of samples: with set means m_s of n_s samples, n in
  /// all, the variance of the mean m is sum_s n_s (m_s - m)^2 / ((sets - 1) n).
  PixelEstimate estimate(int x, int y) const;
  std::uint64_t rays(int x, int y) const { return rays_[index(x, y)]; }

  /// Means, and their variance where every pixel knows it.
  Image image() const;

  /// The mean relative standard error: root of the mean over pixels and channels of variance / radiance^2. Radiance is
  /// that of the pixel and its neighbours, 3x3, so that a rare bright sample is not divided by itself; in the dark it
  /// is half of the picture's mean. Infinite while a pixel does not know its variance.
  double relative_error(ErrorOf of = ErrorOf::picture) const;

  /// Share of the pixels that are undecided, see SampleSums.
  double undecided() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // The mean of the pixel and its neighbours.
  Eigen::Array3d around(const std::vector<Eigen::Array3d>& means, int x, int y) const;

  int width_, height_, sets_;
  std::vector<Eigen::Array3d> sums_;  ///< sets_ of every pixel
  std::vector<std::uint32_t> counts_; ///< the same
  std::vector<SampleSums> samples_;
  std::vector<std::uint64_t> rays_;
};

} // namespace render
