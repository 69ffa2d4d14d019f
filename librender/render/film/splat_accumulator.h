#pragma once
/// Samples that count for several pixels.

#include <render/film/film.h>

namespace render {

/// What the samples of one pixel's square give to the pixels about it, see SplatFilter.
class SplatAccumulator {
 public:
  /// The filter must outlive it.
  explicit SplatAccumulator(const SplatFilter& filter);

  /// A sample at `offset` from the pixel's centre [pixels].
  void add(const Vec2& offset, const Spectrum& radiance);

  /// Adds to a set of the film what was added since the last time. The pixel (x, y) may lie outside of the film.
  void flush_to(Film& film, int x, int y, int set);

 private:
  const SplatFilter& filter_;
  std::vector<double> columns_, rows_;
  std::vector<Eigen::Array4d> sums_; ///< of weights times (radiance, 1), row by row
};

} // namespace render
