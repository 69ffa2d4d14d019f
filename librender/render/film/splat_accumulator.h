#pragma once
/// Accumulation of splats.

#include <render/film/film_block.h>

namespace render {

/// Accumulates the splats of samples in the square of one pixel; see SplatFilter.
class SplatAccumulator {
 public:
  /// Accumulates splats with a filter, which must outlive this.
  explicit SplatAccumulator(const SplatFilter& filter);

  /// Adds a sample at an offset from the pixel's centre [pixels].
  void add(const Vec2& offset, const Spectrum& radiance);

  /// Adds the splats since the last call to a point set of the block. The samples lie in the square of pixel (x, y).
  /// This pixel may be outside the film.
  void flush_to(FilmBlock& block, int x, int y, int set);

 private:
  const SplatFilter& filter_;
  std::vector<double> columns_, rows_;
  std::vector<Eigen::Array4d> sums_; ///< Sums of weights times (radiance, 1), row by row.
};

} // namespace render
