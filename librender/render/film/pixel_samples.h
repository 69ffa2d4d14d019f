#pragma once
/// Samples of one pixel, on their way into a block.

#include <render/film/film_block.h>

namespace render {

/// Collects the samples of a pixel; with a filter of splatting their splats, too. See SplatFilter.
///   use : for each set add() its samples, then end_set(); after the last set end_pixel(), and on to the next pixel.
class PixelSamples {
 public:
  /// Collects samples; none: without splats. The filter must outlive this.
  explicit PixelSamples(const std::optional<SplatFilter>& splat);

  /// Adds a sample at an offset from the pixel's centre [pixels].
  void add(const Vec2& offset, const Spectrum& radiance) {
    const Eigen::Array3d value = radiance.cast<double>();
    all_.add(value);
    ++valid_;
    if (filter_) splat(offset, value);
    else sum_ += value;
  }

  /// Counts a sample that was left out since it was not finite.
  void leave_out() { ++left_out_; }

  /// Adds the set to a block. Pixel (x, y) may be outside the film, which then gets the splats only.
  ///   weight : number of samples for which the samples of the set count, if they are splatted; none: their own number.
  void end_set(FilmBlock& block, int x, int y, int set, std::optional<double> weight = {});

  /// Records the statistics of all sets, and the number of rays that they took.
  void end_pixel(FilmBlock& block, int x, int y, std::uint64_t rays);

 private:
  void splat(const Vec2& offset, const Eigen::Array3d& value);

  const SplatFilter* filter_;
  std::vector<double> columns_, rows_;
  std::vector<Eigen::Array4d> splats_; ///< Sums of weights times (radiance, 1), row by row, of the current set.
  Eigen::Array3d sum_ = Eigen::Array3d::Zero(); ///< Sum of the current set.
  std::uint32_t valid_ = 0,                     ///< Number of finite samples in the current set.
      left_out_ = 0;                            ///< Number of others.
  SampleSums all_;
};

} // namespace render
