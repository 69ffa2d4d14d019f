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
  ///   splat, light_tracer : as for PixelRenderer.
  TileRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points, const ImageExtent& extent,
               const std::optional<SplatFilter>& splat = {}, const LightTracer* light_tracer = nullptr);

  /// Whether tiles begin at row y of the film. Tiles that begin above the film and its border count as beginning at the
  /// first row.
  bool starts_tile_row(int y) const { return y == -border() || place(extent_.crop.y + y) == 0; }

  /// Position of the film's pixels in their tiles.
  Tiling tiling() const { return {side, place(extent_.crop.x), place(extent_.crop.y)}; }

  /// Adds the samples of the tiles that begin at row y, within the columns from `column` on, to a block. The pixels of
  /// a tile whose first column is column + i have the samples [from[i], to[i]). Samples that are not finite are left
  /// out and counted.
  ///   weight : as in PixelSamples::end_set().
  RenderStats render_row(int y, int column, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         FilmBlock& block, std::optional<double> weight = {}) const;

 private:
  static constexpr int side = PathReuseIntegrator<Scene>::side;
  static constexpr std::size_t pixels = PathReuseIntegrator<Scene>::pixels;

  // A pixel of a tile.
  struct Pixel {
    int x = 0, y = 0;    ///< Position in the full image.
    bool counts = false; ///< Whether the film or its border contains the pixel.
    PixelSamples samples;
  };
  using Tile = std::array<Pixel, pixels>;

  int border() const { return splat_ ? splat_->reach() : 0; }
  // Row or column within a tile, of one of the full image.
  static int place(int at) { return ((at % side) + side) % side; }

  using AnyIntegrator = std::variant<PathReuseIntegrator<Scene>, PathReuseIntegrator<Scene, LightPathMis>>;
  static AnyIntegrator integrator_for(const Scene& scene, const PathOptions& path, const LightTracer* light_tracer);
  template <class Stream, class Integrator>
  RenderStats render_row_with(const Integrator& integrator, int y, int column, std::span<const std::uint32_t> from,
                              std::span<const std::uint32_t> to, FilmBlock& block, std::optional<double> weight) const;
  template <class Stream, class Integrator>
  void render_tile(const Integrator& integrator, Tile& tile, std::uint32_t from, std::uint32_t to, FilmBlock& block,
                   std::optional<double> weight, RenderStats& stats) const;
  template <class Stream, class Integrator>
  void render_range(const Integrator& integrator, const PixelPoints::PointRange& range, Tile& tile,
                    RenderStats& stats) const;

  const Scene& scene_;
  PixelRays pixel_rays_;
  AnyIntegrator integrator_;
  PixelPoints points_;
  ImageExtent extent_;
  std::optional<SplatFilter> splat_;
};

} // namespace render
