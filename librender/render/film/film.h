#pragma once
/// Where samples become an image with an error bar.

#include <render/film/image.h>

#include <mc/estimate/moments.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace render {

/// The first sample that was not finite: enough to trace it again.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t pass = 0, index = 0;
};

/// Luminances of a pixel's samples: enough to see whether one of them decides.
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

/// Per-pixel, per-channel moments of independent estimates; non-finite samples are counted, never clamped or blackened.
class Film {
 public:
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Adds one independent estimate of the pixel. Pixels may be written by different threads; one pixel by one at a
  /// time.
  void add(int x, int y, const Eigen::Array3d& estimate);

  /// Tells of the samples behind the estimates.
  void note(int x, int y, const SampleSums& samples) { samples_[index(x, y)].merge(samples); }

  /// Means, and the variance of each mean where a pixel has at least two estimates.
  Image image() const;

  /// Root of the mean variance over pixels and channels, relative to the mean radiance; infinite before the second
  /// estimate.
  double relative_error() const;

  /// Share of the pixels that are undecided, see SampleSums.
  double undecided() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  using Pixel = std::array<mc::Moments, 3>;
  int width_, height_;
  std::vector<Pixel> pixels_;
  std::vector<SampleSums> samples_;
};

} // namespace render
