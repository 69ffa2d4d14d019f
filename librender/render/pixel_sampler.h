#pragma once
/// Samples of pixels.

#include <render/film/splat.h>
#include <render/integrator/path.h>
#include <render/scene/scene.h>

#include <mc/sampler/walk_stream.h>

#include <span>
#include <string_view>

namespace render {

// Compiled once: who follows paths through a Scene need not.
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::IndependentWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::StratifiedWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;
extern template Spectrum PathIntegrator<Scene>::radiance(const Ray&, mc::SobolWalk<Float>&, std::uint64_t&,
                                                         const Media&) const;

/// Point sets for a pixel's samples.
enum class PixelSampler { independent, stratified, sobol };
/// Throws Error, naming the nearest sampler, for an unknown name.
PixelSampler sampler_from(std::string_view name);
std::string_view name(PixelSampler sampler);

/// What was done, in how many samples and rays.
struct Tally {
  std::uint64_t samples = 0, rays = 0;
  std::uint64_t invalid = 0; ///< samples that were not finite
  InvalidSample first;       ///< of them, in the order of passes, rows, columns and indices

  void add(const InvalidSample& sample);
  void merge(const Tally& other);
};

/// A part of a picture, from the pixel (x, y), counted from the upper left corner.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// A picture of which a film shows a part.
struct Whole {
  int width, height;
  Crop part;
};

/// The samples of a picture's pixels, each a pure function of the seed, the pixel and its number. Those of a pixel are
/// dealt in turn to the film's point sets, which are randomised independently: sample k is point k / sets of set
/// k % sets. A stratified set that is longer than `stratum` points goes on with another. The pixels of a part are those
/// of the whole.
class SampleTaker {
 public:
  /// splat       : by which samples count for several pixels; unless given, each for one, from the scene's filter
  /// light_paths : see PathIntegrator
  SampleTaker(const Scene& scene, const PathOptions& path, PixelSampler sampler, std::uint64_t seed,
              std::uint32_t stratum, const Whole& whole, const std::optional<SplatFilter>& splat = {},
              const LightPaths* light_paths = nullptr);

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

  // A lens, or what is cut away before it, may reach out of the body that holds its centre.
  Media around(const Ray& ray) const { return around_varies_ ? media_at(scene_, ray) : around_; }

  const Scene& scene_;
  Media around_; ///< through what rays start
  bool around_varies_;
  PathIntegrator<Scene> integrator_;
  std::uint64_t seed_;
  std::uint32_t stratum_;
  Whole whole_;
  std::optional<SplatFilter> splat_;
  Take take_;
};

} // namespace render
