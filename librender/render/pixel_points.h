#pragma once
/// Where the samples of pixels start: their places in point sets, and their rays.

#include <render/integrator/medium_stack.h>
#include <render/scene/scene.h>

#include <mc/random/hash.h>
#include <mc/sampler/path_sample_stream.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace render {

/// Point sets for a pixel's samples.
enum class PixelSampler { independent, stratified, sobol };
/// Throws Error, naming the nearest sampler, for an unknown name.
PixelSampler sampler_from(std::string_view name);
std::string_view name(PixelSampler sampler);

/// Calls task(std::type_identity<Stream>()) with the streams of a sampler's points, and returns what it does.
template <class Task> auto with_stream(PixelSampler sampler, const Task& task) {
  switch (sampler) {
  case PixelSampler::independent: break;
  case PixelSampler::stratified: return task(std::type_identity<mc::StratifiedPathStream<Float>>());
  case PixelSampler::sobol: return task(std::type_identity<mc::SobolPathStream<Float>>());
  }
  return task(std::type_identity<mc::IndependentPathStream<Float>>());
}

/// A part of a picture, from the pixel (x, y), counted from the upper left corner.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// A picture of which a film shows a part.
struct ImageExtent {
  int width, height;
  Crop crop;
};

/// The points of a picture's pixels, each a pure function of the seed, the pixel and the number of its sample. Those of
/// a pixel are dealt in turn to its point sets, which are randomised independently: sample k is point k / sets of set
/// k % sets. A stratified set that is longer than `set_size` points goes on with another.
struct PixelPoints {
  PixelSampler sampler;
  std::uint64_t seed;
  std::uint32_t set_size; ///< of sets that are not stratified 2^31

  PixelPoints(PixelSampler kind, std::uint64_t own_seed, std::uint32_t points)
      : sampler(kind), seed(own_seed), set_size(kind == PixelSampler::stratified ? points : 1u << 31) {}

  /// Points that follow each other, of one randomisation.
  struct PointRange {
    std::uint32_t pass; ///< the randomisation
    std::uint32_t begin, end;
  };

  /// Calls task(run) for the runs of the set that the samples [first, last) of a pixel belong to.
  template <class Task>
  void for_ranges(std::uint32_t set, std::uint32_t sets, std::uint32_t first, std::uint32_t last,
                  const Task& task) const {
    const std::uint32_t end = (last + sets - 1 - set) / sets;
    for (std::uint32_t point = (first + sets - 1 - set) / sets; point < end;) {
      const std::uint32_t block = point / set_size, start = block * set_size;
      const std::uint32_t stop = std::min(end, start + set_size);
      task(PointRange{set + sets * block, point - start, stop - start});
      point = stop;
    }
  }

  /// The points of a run, for the pixel (x, y) of the whole picture.
  template <class Points> Points point_set(int x, int y, const PointRange& range) const {
    const std::uint64_t pixel = std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x);
    return Points(mc::hash(seed, pixel, range.pass), set_size);
  }
};

/// The rays of a scene's camera through the pixels of a picture. The scene must outlive it.
class PixelRays {
 public:
  PixelRays(const Scene& scene, const ImageExtent& extent)
      : scene_(scene), scale_(1 / Float(extent.width), 1 / Float(extent.height)),
        tan_half_(scene.camera().tan_half(Float(extent.width) / Float(extent.height))),
        media_(initial_media(scene, {scene.camera().origin(), scene.camera().forward()})),
        media_vary_(has_media(scene) && (scene.camera().radius() > 0 || scene.camera().near() > 0)) {}

  /// Through the point at `offset` from the centre of the pixel (x, y) of the whole picture [pixels].
  template <class Stream> Ray sample(int x, int y, const Vec2& offset, Stream& stream) const {
    const ThinLens& camera = scene_.camera();
    const Vec2 s = (Vec2(Float(x) + Float(0.5), Float(y) + Float(0.5)) + offset).cwiseProduct(scale_);
    return camera.ray(s, tan_half_, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
  }

  /// Through what a ray starts. A lens, or what is cut away before it, may reach out of the body that holds its centre.
  MediumStack media(const Ray& ray) const { return media_vary_ ? initial_media(scene_, ray) : media_; }

 private:
  const Scene& scene_;
  Vec2 scale_, tan_half_;
  MediumStack media_;
  bool media_vary_;
};

} // namespace render
