#pragma once
/// Light paths of a render.

#include <render/pixel_renderer.h>

#include <vector>

namespace render {

/// Traces the light paths of an image. Each path is a pure function of the seed and its number. Paths are dealt in turn
/// to the film's point sets, like the samples of a pixel. Each connection to the camera adds to one nearby pixel,
/// selected in proportion to the filter.
class LightTracingPass {
 public:
  /// The scene and the light tracer must outlive this.
  LightTracingPass(const Scene& scene, const LightTracer& light_tracer, int max_depth, PixelSampler sampler,
                   std::uint64_t seed, const ImageExtent& extent);

  /// Number of light paths for `mean` samples per pixel. Tiny images get a minimum number of paths.
  std::uint64_t path_count(double mean) const;

  static constexpr std::uint64_t block_size = 1024; ///< Number of light paths that a thread traces at a time.
  /// Number of light paths of which the film is told together.
  static constexpr std::uint64_t batch_size = 64 * block_size;

  /// Adds the contributions of the light paths [from, to) to a block. Contributions that are not finite are left out
  /// and counted.
  RenderStats trace(std::uint64_t from, std::uint64_t to, FilmBlock& block) const {
    return (this->*trace_)(from, to, block);
  }
  /// Adds the light paths [from, to) to the counts of the film.
  void count_paths(std::uint64_t from, std::uint64_t to, Film& film) const;

 private:
  template <class Stream> RenderStats trace_with(std::uint64_t from, std::uint64_t to, FilmBlock& block) const;

  // Number of light paths per sample of every pixel.
  double per_sample() const { return light_tracer_.light_path_rate() * double(extent_.width) * double(extent_.height); }

  // A pixel along one axis, with the sum of the filter's values over all candidates.
  struct PixelChoice {
    int pixel;
    double weight;
  };
  // Selects a pixel near `at` with u in [0,1), in proportion to the filter.
  PixelChoice sample_pixel(double at, Float u, std::vector<double>& profile) const;

  using Trace = RenderStats (LightTracingPass::*)(std::uint64_t, std::uint64_t, FilmBlock&) const;
  static Trace trace_for(PixelSampler sampler);

  const LightTracer& light_tracer_;
  SplatFilter filter_;
  int max_depth_;
  std::uint64_t seed_;
  std::uint64_t run_length_; ///< Number of points in a set; longer runs use further sets
  ImageExtent extent_;
  Trace trace_;
};

} // namespace render
