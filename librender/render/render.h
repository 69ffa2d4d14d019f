#pragma once
/// From a scene to an image with an error bar.

#include <render/film/film.h>
#include <render/integrator/path.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string_view>

namespace render {

/// Point sets for a pixel's samples.
enum class PixelSampler { independent, stratified, sobol };
/// Throws Error, naming the nearest sampler, for an unknown name.
PixelSampler sampler_from(std::string_view name);
std::string_view name(PixelSampler sampler);

struct Progress {
  double fraction = 0; ///< of the work, in [0,1]
  std::uint64_t samples = 0, rays = 0;
  double seconds = 0;
  double relative_error = 0; ///< infinite while unknown
  double undecided = 0;      ///< as in RenderResult, when the error was last known
};

/// While a larger share of the pixels is undecided, a picture has not reached a target error.
inline constexpr double most_undecided = 0.05;

/// A part of a picture, from the pixel (x, y), counted from the upper left corner.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

struct RenderOptions {
  int width = 256, height = 256;
  std::optional<Crop>
      crop;     ///< only this part: of a given number of samples, the pixels of the whole picture, bit for bit
  int spp = 64; ///< samples per pixel, unless one of the next two is given
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< relative RMS standard error of the pixels, see most_undecided
  Strategy strategy = strategy_from("mis");
  PixelSampler sampler = PixelSampler::sobol;
  int max_depth = -1; ///< longest path in edges; -1: no limit
  Shown shown = Shown::radiance;
  std::uint64_t seed = 0;
  int threads = 0;                               ///< 0: all of the machine's
  std::function<void(const Progress&)> progress; ///< called after every row, from any of the threads, also at once
  const std::atomic<bool>* cancel = nullptr;     ///< set it to stop after the rows under way
};

struct RenderResult {
  Image image; ///< with variance where a pixel has two independent estimates or more
  std::uint64_t samples = 0, rays = 0;
  double spp = 0;              ///< samples per pixel taken
  std::uint32_t estimates = 0; ///< independent estimates per pixel behind the variance
  double seconds = 0, cpu_seconds = 0;
  double relative_error = 0; ///< see Film::relative_error
  double undecided = 0;      ///< share of the pixels whose error bar is not known yet, see Film::undecided
  std::uint64_t invalid = 0; ///< samples that were not finite; they are left out of the image
  InvalidSample first_invalid;
  bool partial = false; ///< cancelled before the end
};

/// Renders in passes. A pass gives every pixel one estimate from an independently randomised point set, so the variance
/// between passes is honest for low-discrepancy points too; with the independent sampler every sample is an estimate of
/// its own. A given number of samples is taken in rounds that grow from one sample of every pass to all of them, so
/// that a picture interrupted after the first is whole and has its variance. The result depends on the seed, not on the
/// number of threads.
///   throws : Error for a non-positive size, sample count, time or error, and a crop that reaches beyond the picture
RenderResult render(const Scene& scene, const RenderOptions& options);

} // namespace render
