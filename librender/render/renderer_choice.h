#pragma once
/// The choice of how the paths of a render are traced.

#include <render/film/sampling_plan.h>
#include <render/render.h>
#include <render/tile_renderer.h>

#include <mc/run/archive.h>

#include <span>
#include <variant>
#include <vector>

namespace render {

/// The renderers that options leave open: of single pixels whose paths have two branches or one, and of tiles. The
/// first of them renders, until a choice is made from a pilot to which all of them contribute.
class RendererChoice {
 public:
  /// Prepares the renderers of a scene, which must outlive this; without adaptive sampling a single one.
  ///   points, extent, splat, light_tracer : as for PixelRenderer.
  RendererChoice(const Scene& scene, const RenderOptions& options, const PixelPoints& points, const ImageExtent& extent,
                 const std::optional<SplatFilter>& splat, const LightTracer* light_tracer);

  /// Adds samples to a block as PixelRenderer::render_row(), or as TileRenderer::render_row() for tiles.
  ///   alternates : whether all renderers contribute, if none is chosen: each block of 4x4 pixels of the full image
  ///                takes one of them, in turn.
  RenderStats render_row(int y, int column, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         FilmBlock& block, std::optional<double> weight, bool alternates) const;

  /// Chooses the renderer with the least product of rays and squared mean of relative standard errors in its blocks of
  /// the pilot. Means of errors, and not of variances, so that a few bright samples do not decide.
  void choose(const Film& pilot);

  /// Tiles of the chosen renderer; tiles of one pixel without a choice, or if it renders single pixels.
  Tiling tiling() const { return chosen_ ? tiling_of(*chosen_) : Tiling{}; }
  /// Tiles of any of the renderers.
  Tiling any_tiling() const { return tiling_of(renderers_.size() - 1); }

  /// Bound of the noise area (see Image) of samples.
  ///   alternating : share of the samples to which all renderers contributed.
  double noise_area(double alternating) const;

  /// The choice, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(chosen_); }

 private:
  using Renderer = std::variant<PixelRenderer, TileRenderer>;

  Tiling tiling_of(std::size_t renderer) const {
    const auto* tiles = std::get_if<TileRenderer>(&renderers_[renderer]);
    return tiles ? tiles->tiling() : Tiling{};
  }
  // Index of the renderer of a pixel of the film or its border.
  std::size_t in_turn(int x, int y) const;

  ImageExtent extent_;
  std::vector<Renderer> renderers_; ///< Tiles last.
  std::optional<std::size_t> chosen_;
};

} // namespace render
