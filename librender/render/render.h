#pragma once
/// From a scene to an image with an error bar.

#include <render/pixel_renderer.h>

#include <atomic>
#include <functional>
#include <optional>

namespace render {

struct Progress {
  double fraction = 0; ///< of the work, in [0,1]
  std::uint64_t samples = 0, rays = 0;
  double seconds = 0;
  double relative_error = 0;    ///< of what the options ask for, see Film; infinite while unknown
  double outlier_dominated = 0; ///< as in RenderResult, when the error was last known
};

/// While a larger share of the pixels is undecided, a picture has not reached a target error.
inline constexpr double max_outlier_dominated = 0.05;

inline constexpr int max_branches = 1024;

struct RenderOptions {
  int width = 256, height = 256;
  std::optional<Crop> crop;           ///< only this part; spent evenly, its pixels are the whole's, bit for bit
  int spp = 64;                       ///< samples per pixel, unless one of the next two, or both, are given
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< what RelativeError::bound is to fall to, see Film; and most_undecided
  ErrorScope error_scope = ErrorScope::image;
  std::optional<bool> adaptive; ///< samples where the error is; unless given: where seconds or an error are
  Strategy strategy = strategy_from("mis+lt");
  PixelSampler sampler = PixelSampler::sobol;
  bool splat = false; ///< samples count for all pixels under the filter, see SplatFilter; spent evenly
  bool tiles = false; ///< pixels share paths by tiles, see PathReuseIntegrator
  int max_depth = -1; ///< longest path in edges; -1: no limit
  int branches = 2;   ///< see PathOptions; tiles share instead
  Aov aov = Aov::radiance;
  std::uint64_t seed = 0;
  int threads = 0;                               ///< 0: all of the machine's
  std::function<void(const Progress&)> progress; ///< called after every row, from any of the threads, also at once
  const std::atomic<bool>* cancel = nullptr;     ///< set it to stop after the rows under way
};

struct RenderResult {
  Image image;                         ///< with variance where every pixel has two point sets or more
  std::uint64_t samples = 0, rays = 0; ///< samples of the pixels; rays of light paths, too
  double spp = 0;                      ///< samples per pixel taken, on average
  std::uint32_t estimates = 0;         ///< independent point sets per pixel behind the variance
  double seconds = 0, cpu_seconds = 0;
  double relative_error = 0;    ///< see RelativeError::value
  double worst_error = 0;       ///< the same of the worst block
  double outlier_dominated = 0; ///< share of the pixels whose error bar is not known yet, see Film::undecided
  double unreliable_target_spp =
      0;                     ///< samples per pixel with the target error, but too many pixels undecided; 0: never so
  std::uint64_t invalid = 0; ///< samples that were not finite; they are left out of the image
  InvalidSample first_invalid;
  bool partial = false;     ///< cancelled before the end
  bool out_of_time = false; ///< before the target error was reached
  int missing_rows = 0;     ///< of the image, cancelled in the first round: they repeat the nearest that was rendered
};

/// Renders in rounds, which double the samples of every pixel, so that a picture interrupted after the first, two
/// samples per pixel, is whole and has its variance. Interrupted before, it has none; rows are taken far from each
/// other, and those that are missing repeat the nearest. A pixel's samples are dealt to two point sets, independently
/// randomised, so that the variance between them is honest for low-discrepancy points too; more sets would be
/// shorter, which costs accuracy, and tell of a pixel what its neighbours tell as well. Light paths, where the
/// strategy has some, are as many as belong to the mean number of samples, and dealt to the sets as well.
/// Where samples go where the error is, about the first quarter is a pilot, spent evenly, which alone decides about the
/// rest, light paths too: see adaptive_plan.
/// The result depends on the seed, not on the number of threads; with `seconds` it depends on the machine's speed.
///   throws : Error for a non-positive size, sample count, time or error, and a crop that reaches beyond the picture,
///            and for a strategy that cannot find every light of the scene, see finds_all_lights
RenderResult render(const Scene& scene, const RenderOptions& options);

} // namespace render
