#pragma once
/// Points and camera rays of the samples of pixels.

#include <render/scene/medium_stack.h>
#include <render/scene/scene.h>

#include <mc/random/hash.h>
#include <mc/sampler/path_sample_stream.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace render {

/// Kinds of point sets for the samples of a pixel.
enum class PixelSampler {
  independent, ///< Independent random points.
  stratified,  ///< Stratified points.
  sobol        ///< Randomised Sobol' points.
};
/// The sampler with this name.
///   throws : Error, with the nearest name, for an unknown name.
PixelSampler sampler_from(std::string_view name);
/// The name of a sampler.
std::string_view name(PixelSampler sampler);

/// Calls task(std::type_identity<Stream>()) with the stream type of a sampler, and returns its result.
template <class Task> auto with_stream(PixelSampler sampler, const Task& task) {
  switch (sampler) {
  case PixelSampler::independent: break;
  case PixelSampler::stratified: return task(std::type_identity<mc::StratifiedPathStream<Float>>());
  case PixelSampler::sobol: return task(std::type_identity<mc::SobolPathStream<Float>>());
  }
  return task(std::type_identity<mc::IndependentPathStream<Float>>());
}

/// A rectangle of pixels. (x, y) is its top left pixel, counted from the top left corner of the image.
struct Crop {
  int x = 0,      ///< Left column.
      y = 0,      ///< Top row.
      width = 0,  ///< Number of columns.
      height = 0; ///< Number of rows.
};

/// The size of an image, and the part that a film contains.
struct ImageExtent {
  int width,  ///< Width of the full image [pixels].
      height; ///< Height of the full image [pixels].
  Crop crop;  ///< Part in the film.
};

/// Points of the samples of all pixels. Each point is a pure function of the seed, the pixel and the sample number. The
/// samples of a pixel are dealt in turn to its independently randomised point sets: sample k is point
/// k / sets of set k % sets. After `set_size` points a stratified set continues with another randomisation.
struct PixelPoints {
  PixelSampler sampler;   ///< Kind of point sets.
  std::uint64_t seed;     ///< Seed of the randomisations.
  std::uint32_t set_size; ///< Number of points of a stratified set; 2^31 for other samplers.

  /// Points of a sampler kind and seed; `points` is the size of stratified sets.
  PixelPoints(PixelSampler kind, std::uint64_t own_seed, std::uint32_t points)
      : sampler(kind), seed(own_seed), set_size(kind == PixelSampler::stratified ? points : 1u << 31) {}

  /// Consecutive points of one randomisation.
  struct PointRange {
    std::uint32_t pass;  ///< Number of the randomisation.
    std::uint32_t begin, ///< First point.
        end;             ///< End of the points; not included.
  };

  /// Calls task(range) for the ranges of points in point set `set` that belong to the samples [first, last) of a pixel.
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

  /// The point set of a range, for the pixel (x, y) of the full image.
  template <class Points> Points point_set(int x, int y, const PointRange& range) const {
    const std::uint64_t pixel = std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x);
    return Points(mc::hash(seed, pixel, range.pass), set_size);
  }
};

/// Camera rays through the pixels of an image. The scene must outlive this.
class PixelRays {
 public:
  /// Prepares the camera rays of an image.
  PixelRays(const Scene& scene, const ImageExtent& extent)
      : scene_(scene), scale_(1 / Float(extent.width), 1 / Float(extent.height)),
        tan_half_(scene.camera().tan_half(Float(extent.width) / Float(extent.height))),
        media_(initial_media(scene, {scene.camera().origin(), scene.camera().forward()})),
        media_vary_(scene.has_media() &&
                    (scene.camera().radius() > 0 || scene.camera().near() > 0 || scene.camera().is_parallel())) {}

  /// A camera ray at an offset from the centre of pixel (x, y) of the full image [pixels].
  template <class Stream> Ray sample(int x, int y, const Vec2& offset, Stream& stream) const {
    const ThinLens& camera = scene_.camera();
    const Vec2 s = (Vec2(Float(x) + Float(0.5), Float(y) + Float(0.5)) + offset).cwiseProduct(scale_);
    return camera.ray(s, tan_half_, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
  }

  /// Media at the origin of a ray. They may differ from the media at the camera if the lens or the near plane extends
  /// out of a body.
  MediumStack media(const Ray& ray) const { return media_vary_ ? initial_media(scene_, ray) : media_; }

 private:
  const Scene& scene_;
  Vec2 scale_, tan_half_;
  MediumStack media_;
  bool media_vary_;
};

} // namespace render
