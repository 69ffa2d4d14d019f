#pragma once
/// Samples of tiles of pixels.

#include <render/film/sampling_plan.h>
#include <render/integrator/path_reuse.h>
#include <render/pixel_renderer.h>

namespace render {

/// The samples of a picture's pixels, by PixelPoints, taken by tiles: those of all its pixels together, see
/// PathReuseIntegrator. Tiles lie where they do in the whole picture, and the pixels of a part are those of the whole.
class TileRenderer {
 public:
  /// light_tracer : see PathIntegrator
  ///   throws    : Error where something else than radiance is to be shown
  TileRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points, const ImageExtent& extent,
               const LightTracer* light_tracer = nullptr);

  /// Whether tiles begin at the film's row y; those that begin above it do at its first.
  bool starts_tile_row(int y) const { return y == 0 || (extent_.crop.y + y) % side == 0; }

  /// Where the film's pixels lie in their tiles.
  Tiling tiling() const { return {side, extent_.crop.x % side, extent_.crop.y % side}; }

  /// Adds to the film the samples [from[x], to[x]) of all pixels of the tiles that begin at its row y, of each of which
  /// x is the first column; what is not finite is left out.
  RenderStats render_row(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         Film& film) const {
    return (this->*render_row_)(y, from, to, film);
  }

 private:
  static constexpr int side = PathReuseIntegrator<Scene>::side;
  static constexpr std::size_t pixels = PathReuseIntegrator<Scene>::pixels;

  /// Of a tile.
  struct Pixel {
    int x, y;    ///< in the whole picture
    bool counts; ///< it is one of the film's
    SampleSums sums = {};
    Eigen::Array3d sum = Eigen::Array3d::Zero(); ///< of the set under way
    std::uint32_t valid = 0;                     ///< samples of it
  };

  using RenderRow = RenderStats (TileRenderer::*)(int, std::span<const std::uint32_t>, std::span<const std::uint32_t>,
                                                  Film&) const;
  template <class Stream>
  RenderStats render_row_with(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                              Film& film) const;
  template <class Stream>
  void render_tile(int left, int top, std::uint32_t from, std::uint32_t to, Film& film, RenderStats& stats) const;
  template <class Stream>
  void render_range(const PixelPoints::PointRange& range, std::array<Pixel, pixels>& tile, RenderStats& stats) const;
  static RenderRow render_row_for(PixelSampler sampler);

  const Scene& scene_;
  PixelRays pixel_rays_;
  PathReuseIntegrator<Scene> integrator_;
  PixelPoints points_;
  ImageExtent extent_;
  RenderRow render_row_;
};

} // namespace render
