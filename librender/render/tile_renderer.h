#pragma once
/// Rendering of tiles of pixels.

#include <render/film/sampling_plan.h>
#include <render/integrator/path_reuse.h>
#include <render/pixel_renderer.h>

namespace render {

/// Renders the samples of pixels in tiles; see PathReuseIntegrator. Points are from PixelPoints. Tiles are aligned to
/// the full image, and a crop has the same pixels as the full image.
class TileRenderer {
 public:
  /// Prepares the rendering of a scene, which must outlive this.
  ///   light_tracer : as for PixelRenderer.
  TileRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points, const ImageExtent& extent,
               const LightTracer* light_tracer = nullptr);

  /// Whether tiles begin at row y of the film. Tiles that begin above the film count as beginning at row 0.
  bool starts_tile_row(int y) const { return y == 0 || (extent_.crop.y + y) % side == 0; }

  /// Position of the film's pixels in their tiles.
  Tiling tiling() const { return {side, extent_.crop.x % side, extent_.crop.y % side}; }

  /// Adds the samples of the tiles that begin at row y, within the columns from `column` on, to a block. The pixels of
  /// a tile whose first column is column + i have the samples [from[i], to[i]). Samples that are not finite are left
  /// out and counted.
  RenderStats render_row(int y, int column, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         FilmBlock& block) const;

 private:
  static constexpr int side = PathReuseIntegrator<Scene>::side;
  static constexpr std::size_t pixels = PathReuseIntegrator<Scene>::pixels;

  // A pixel of a tile.
  struct Pixel {
    int x, y;    ///< Position in the full image
    bool counts; ///< Whether the film contains the pixel
    SampleSums sums = {};
    Eigen::Array3d sum = Eigen::Array3d::Zero(); ///< Sum of the current set
    std::uint32_t valid = 0;                     ///< Number of finite samples in the current set
  };

  using AnyIntegrator = std::variant<PathReuseIntegrator<Scene>, PathReuseIntegrator<Scene, LightPathMis>>;
  static AnyIntegrator integrator_for(const Scene& scene, const PathOptions& path, const LightTracer* light_tracer);
  template <class Stream, class Integrator>
  RenderStats render_row_with(const Integrator& integrator, int y, int column, std::span<const std::uint32_t> from,
                              std::span<const std::uint32_t> to, FilmBlock& block) const;
  template <class Stream, class Integrator>
  void render_tile(const Integrator& integrator, int left, int top, std::uint32_t from, std::uint32_t to,
                   FilmBlock& block, RenderStats& stats) const;
  template <class Stream, class Integrator>
  void render_range(const Integrator& integrator, const PixelPoints::PointRange& range, std::array<Pixel, pixels>& tile,
                    RenderStats& stats) const;

  const Scene& scene_;
  PixelRays pixel_rays_;
  AnyIntegrator integrator_;
  PixelPoints points_;
  ImageExtent extent_;
};

} // namespace render
