#pragma once
/// Samples of pixels.

#include <render/film/splat.h>
#include <render/integrator/path.h>
#include <render/pixel_points.h>

#include <span>

namespace render {

// Compiled once: who follows paths through a Scene need not.
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::IndependentWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::StratifiedWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::SobolWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;

/// What was done, in how many samples and rays.
struct Tally {
  std::uint64_t samples = 0, rays = 0;
  std::uint64_t invalid = 0; ///< samples that were not finite
  InvalidSample first;       ///< of them, in the order of passes, rows, columns and indices

  void add(const InvalidSample& sample);
  void merge(const Tally& other);
};

/// The samples of a picture's pixels, by PixelPoints. The pixels of a part are those of the whole.
class SampleTaker {
 public:
  /// splat       : by which samples count for several pixels; unless given, each for one, from the scene's filter
  /// light_paths : see PathIntegrator
  SampleTaker(const Scene& scene, const PathOptions& path, const PixelPoints& points, const Whole& whole,
              const std::optional<SplatFilter>& splat = {}, const LightPaths* light_paths = nullptr);

  /// Rows above and below the film, and columns at its sides, of which samples count for its pixels.
  int border() const { return splat_ ? splat_->reach() : 0; }

  /// Adds to the film the samples [from[x], to[x]) of the pixels of its row y, the first of them `border` to the left
  /// of it; what is not finite is left out. Writes to the rows within `border` of y.
  Tally take(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, Film& film) const {
    return (this->*take_)(y, from, to, film);
  }

 private:
  using Take = Tally (SampleTaker::*)(int, std::span<const std::uint32_t>, std::span<const std::uint32_t>, Film&) const;
  template <class Stream>
  Tally take_by(int y, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, Film& film) const;
  static Take take_of(PixelSampler sampler);

  const Scene& scene_;
  PixelRays pixel_rays_;
  PathIntegrator<Scene> integrator_;
  PixelPoints points_;
  Whole whole_;
  std::optional<SplatFilter> splat_;
  Take take_;
};

} // namespace render
