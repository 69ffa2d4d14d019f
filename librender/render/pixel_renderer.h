#pragma once
/// Samples of pixels.

#include <render/film/splat_accumulator.h>
#include <render/integrator/path_integrator.h>
#include <render/pixel_points.h>

#include <span>

namespace render {

// Compiled once: who follows paths through a Scene need not.
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::IndependentPathStream<Float>&, std::uint64_t&,
                                                         const MediumStack&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::StratifiedPathStream<Float>&, std::uint64_t&,
                                                         const MediumStack&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::SobolPathStream<Float>&, std::uint64_t&,
                                                         const MediumStack&) const;

/// What was done, in how many samples and rays.
struct RenderStats {
  std::uint64_t samples = 0, rays = 0;
  std::uint64_t invalid = 0;   ///< samples that were not finite
  InvalidSample first_invalid; ///< of them, in the order of passes, rows, columns and indices

  void add(const InvalidSample& sample);
  void merge(const RenderStats& other);
};

/// The samples of a picture's pixels, by PixelPoints. The pixels of a part are those of the whole.
class PixelRenderer {
 public:
  /// splat       : by which samples count for several pixels; unless given, each for one, from the scene's filter
  /// light_tracer : see PathIntegrator
  PixelRenderer(const Scene& scene, const PathOptions& path, const PixelPoints& points, const ImageExtent& extent,
                const std::optional<SplatFilter>& splat = {}, const LightTracer* light_tracer = nullptr);

  /// Rows above and below the film, and columns at its sides, of which samples count for its pixels.
  int border() const { return splat_ ? splat_->reach() : 0; }

  /// Adds to the film the samples [from[x], to[x]) of the pixels of its row y, the first of them `border` to the left
  /// of it; what is not finite is left out. Writes to the rows within `border` of y.
  RenderStats render_row(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                         Film& film) const {
    return (this->*render_row_)(y, from, to, film);
  }

 private:
  using RenderRow = RenderStats (PixelRenderer::*)(int, std::span<const std::uint32_t>, std::span<const std::uint32_t>,
                                                   Film&) const;
  template <class Stream>
  RenderStats render_row_with(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                              Film& film) const;
  static RenderRow render_row_for(PixelSampler sampler);

  const Scene& scene_;
  PixelRays pixel_rays_;
  PathIntegrator<Scene> integrator_;
  PixelPoints points_;
  ImageExtent extent_;
  std::optional<SplatFilter> splat_;
  RenderRow render_row_;
};

} // namespace render
