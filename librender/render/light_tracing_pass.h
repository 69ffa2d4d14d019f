#pragma once
/// Light paths of a render.

#include <render/pixel_renderer.h>

#include <functional>
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

  static constexpr std::uint64_t batch_size = 65536; ///< Number of light paths between calls of `stop`.

  /// Adds the light paths [from, to) to the film. Results do not depend on the number of threads. Contributions that
  /// are not finite are left out and counted in `stats`. Ends early after `stop()` returns true.
  ///   returns : number of the first path that was not traced.
  std::uint64_t add_paths(std::uint64_t from, std::uint64_t to, int threads, const std::function<bool()>& stop,
                          Film& film, RenderStats& stats) const;

 private:
  // A contribution to a pixel of the film.
  struct LightSplat {
    int x, y, set;
    Spectrum value;
  };
  struct SplatBuffer {
    std::vector<LightSplat> splats;
    RenderStats stats;

    // Adds a contribution to the pixel (x, y) of the full image, if it is in the film.
    void add(const Crop& film, int x, int y, int set, const Spectrum& value) {
      const int column = x - film.x, row = y - film.y;
      if (column >= 0 && column < film.width && row >= 0 && row < film.height)
        splats.push_back({column, row, set, value});
    }
  };
  template <class Stream>
  void trace(std::uint64_t from, std::uint64_t to, std::uint32_t sets, SplatBuffer& buffer) const;

  // Number of light paths per sample of every pixel.
  double per_sample() const { return light_tracer_.light_path_rate() * double(extent_.width) * double(extent_.height); }

  // A pixel along one axis, with the sum of the filter's values over all candidates.
  struct PixelChoice {
    int pixel;
    double weight;
  };
  // Selects a pixel near `at` with u in [0,1), in proportion to the filter.
  PixelChoice sample_pixel(double at, Float u, std::vector<double>& profile) const;

  using Trace = void (LightTracingPass::*)(std::uint64_t, std::uint64_t, std::uint32_t, SplatBuffer&) const;
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
