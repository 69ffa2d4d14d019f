#pragma once
/// Where samples become an image with an error bar.

#include <render/film/image.h>

#include <mc/estimate/moments.h>

#include <array>
#include <cstdint>
#include <optional>

namespace render {

/// The first sample that was not finite: enough to trace it again.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t pass = 0, index = 0;
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

  /// Means, and the variance of each mean where a pixel has at least two estimates.
  Image image() const;

  /// Root of the mean variance over pixels and channels, relative to the mean radiance; infinite before the second
  /// estimate.
  double relative_error() const;

 private:
  using Pixel = std::array<mc::Moments, 3>;
  int width_, height_;
  std::vector<Pixel> pixels_;
};

} // namespace render
