#pragma once
/// What paths from the lights give to the pixels.

#include <render/pixel_renderer.h>

#include <functional>
#include <vector>

namespace render {

/// Paths from the lights of a picture, each a pure function of the seed and its number. They are dealt in turn to the
/// film's point sets, as the samples of a pixel are, and the light of each connection to the camera goes to one pixel
/// about it, chosen by the scene's filter.
class LightTracingPass {
 public:
  /// light_paths, and the scene that they are of, must outlive it.
  LightTracingPass(const Scene& scene, const LightTracer& light_tracer, int max_depth, PixelSampler sampler,
                   std::uint64_t seed, const ImageExtent& extent);

  /// As many paths as belong to `mean` samples of every pixel; of a tiny picture more.
  std::uint64_t path_count(double mean) const;

  static constexpr std::uint64_t batch_size = 65536; ///< paths from one look at `stop` to the next

  /// Adds to the film the paths [from, to), in this order whatever the number of threads; what is not finite is left
  /// out. Stops early once `stop()`.
  ///   returns : the number of the first path that was not traced
  std::uint64_t add_paths(std::uint64_t from, std::uint64_t to, int threads, const std::function<bool()>& stop,
                          Film& film, RenderStats& stats) const;

 private:
  /// Light for a pixel of the film.
  struct LightSplat {
    int x, y, set;
    Spectrum value;
  };
  struct SplatBuffer {
    std::vector<LightSplat> splats;
    RenderStats stats;

    /// Light for the pixel (x, y) of the picture, if it is one of the film's.
    void add(const Crop& film, int x, int y, int set, const Spectrum& value) {
      const int column = x - film.x, row = y - film.y;
      if (column >= 0 && column < film.width && row >= 0 && row < film.height)
        splats.push_back({column, row, set, value});
    }
  };
  template <class Stream>
  void trace(std::uint64_t from, std::uint64_t to, std::uint32_t sets, SplatBuffer& buffer) const;

  // Paths that belong to a sample of every pixel.
  double per_sample() const { return light_tracer_.light_path_rate() * double(extent_.width) * double(extent_.height); }

  /// A pixel along one axis, and the sum of the filter's values over all.
  struct PixelChoice {
    int pixel;
    double weight;
  };
  // By u in [0,1) one of those about `at`, with probability in proportion to the filter there.
  PixelChoice sample_pixel(double at, Float u, std::vector<double>& profile) const;

  using Trace = void (LightTracingPass::*)(std::uint64_t, std::uint64_t, std::uint32_t, SplatBuffer&) const;
  static Trace trace_for(PixelSampler sampler);

  const LightTracer& light_tracer_;
  SplatFilter filter_;
  int max_depth_;
  std::uint64_t seed_;
  std::uint64_t run_length_; ///< points of a set; longer ones go on with another
  ImageExtent extent_;
  Trace trace_;
};

} // namespace render
