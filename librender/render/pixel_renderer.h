#pragma once
/// Rendering of pixels.

#include <render/film/pixel_samples.h>
#include <render/integrator/aov.h>
#include <render/integrator/light_path_mis.h>
#include <render/integrator/path_integrator.h>
#include <render/pixel_points.h>

#include <span>
#include <variant>

namespace render {

// Compiled once, in pixel_renderer.cpp: other files that trace paths through a Scene need not instantiate them.
extern template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::IndependentPathStream<Float>&, std::uint64_t&,
                                                   const MediumStack&) const;
extern template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::StratifiedPathStream<Float>&, std::uint64_t&,
                                                   const MediumStack&) const;
extern template Spectrum PathIntegrator<Scene>::Li(const Ray&, mc::SobolPathStream<Float>&, std::uint64_t&,
                                                   const MediumStack&) const;

/// Counts of samples and rays.
struct RenderStats {
  std::uint64_t samples = 0,   ///< Number of samples.
      rays = 0;                ///< Number of rays.
  std::uint64_t invalid = 0;   ///< Number of samples that were not finite.
  InvalidSample first_invalid; ///< The first of them, in the order of passes, rows, columns and indices.

  /// Counts an invalid sample.
  void add(const InvalidSample& sample);
  /// Adds other counts.
  void merge(const RenderStats& other);
  /// The counts, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(samples, rays, invalid, first_invalid); }
};

/// Renders the samples of pixels with points of PixelPoints. A crop has the same pixels as the full image.
class PixelRenderer {
 public:
  /// Prepares the rendering of a scene, which must outlive this.
  ///   splat        : filter of splatting; none: each sample counts for one pixel.
  ///   light_tracer : traces the light paths of the image; null: no light paths.
  ///   aov          : quantity to render; the other options apply to radiance.
  PixelRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points, const ImageExtent& extent,
                const std::optional<SplatFilter>& splat = {}, const LightTracer* light_tracer = nullptr,
                const Aov& aov = {});

  /// Width of the border around the film with samples that count for its pixels [pixels].
  int border() const { return splat_ ? splat_->reach() : 0; }

  /// Adds the samples [from[i], to[i]) of the pixels (column + i, y) of the film to a block. Pixels may lie in the
  /// border. Samples that are not finite are left out and counted.
  ///   weight : as in PixelSamples::end_set().
  RenderStats render_row(int y, int column, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         FilmBlock& block, std::optional<double> weight = {}) const;

 private:
  using AnyIntegrator = std::variant<PathIntegrator<Scene>, PathIntegrator<Scene, LightPathMis>, AovIntegrator<Scene>>;
  static AnyIntegrator integrator_for(const Scene& scene, const PathOptions& path, const Aov& aov,
                                      const LightTracer* light_tracer);
  template <class Stream, class Integrator>
  RenderStats render_row_with(const Integrator& integrator, int y, int column, std::span<const std::uint32_t> from,
                              std::span<const std::uint32_t> to, FilmBlock& block, std::optional<double> weight) const;

  const Scene& scene_;
  PixelRays pixel_rays_;
  AnyIntegrator integrator_;
  PixelPoints points_;
  ImageExtent extent_;
  std::optional<SplatFilter> splat_;
};

} // namespace render
