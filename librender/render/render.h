#pragma once
/// Rendering of a scene into an image with error bars.

#include <render/pixel_renderer.h>

#include <mc/run/executor.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace render {

/// Progress of a render.
struct Progress {
  double fraction = 0;       ///< Share of the work that is done, in [0,1].
  std::uint64_t samples = 0, ///< Number of samples so far.
      rays = 0;              ///< Number of rays so far.
  double seconds = 0;        ///< Time since the start [s].
  RelativeError error;       ///< Error in the scope of the options. Infinite while unknown.
  /// Image of the samples so far. Call it during the progress only; it takes time, and other threads may wait.
  std::function<Image()> image = {};
};

/// Largest number of branches of a path.
inline constexpr int max_branches = 1024;

/// Least number of samples of an image with a target error: no error bar covers light that no path met. At least one
/// path of a kind with a probability of 3e-5 is met with a probability of 95 %.
inline constexpr double min_target_samples = 1e5;

/// Options of a render.
struct RenderOptions {
  int width = 256,  ///< Width of the full image [pixels].
      height = 256; ///< Height of the full image [pixels].
  /// Part to render; none: all. Without adaptive sampling its pixels have the same bits as in the full image.
  std::optional<Crop> crop;
  int spp = 64;                               ///< Samples per pixel; ignored if `seconds` or `target_error` is given.
  std::optional<double> seconds;              ///< Wall-clock limit [s].
  std::optional<double> target_error;         ///< Upper limit of RelativeError::bound; see min_target_samples.
  ErrorScope error_scope = ErrorScope::image; ///< Pixels over which the error is averaged.
  bool adaptive = true; ///< Whether to sample adaptively, after the first 16 samples of every pixel.
  Strategy strategy = strategy_from("mis+lt"); ///< How paths find light.
  PixelSampler sampler = PixelSampler::sobol;  ///< Point sets of pixels.
  /// Whether samples count for all pixels under the filter (SplatFilter). Not for filters as narrow as a pixel or wider
  /// than SplatFilter::max_radius, nor with one sample per pixel.
  bool splat = true;
  /// Whether pixels share paths in tiles; see PathReuseIntegrator. None: if the pilot of adaptive sampling favours it.
  /// Not in scenes whose media scatter or have invisible boundaries.
  std::optional<bool> tiles;
  int max_depth = -1; ///< Largest number of edges of a path; -1: no limit.
  /// Number of branches as in PathOptions. None: 2, and after a pilot 1 or 2, as it favours. Not with tiles.
  std::optional<int> branches;
  Aov aov = Aov::radiance;                       ///< Quantity to render.
  std::uint64_t seed = 0;                        ///< Seed of all random numbers.
  int threads = 0;                               ///< Number of threads; 0: all of the machine.
  std::function<void(const Progress&)> progress; ///< Called after every unit of pixels by any thread, one at a time.
  const std::atomic<bool>* cancel = nullptr;     ///< Stops the render after the current units once it is true.
  /// Saves and restores the samples. A render that goes on with a larger `spp` takes the samples behind them.
  mc::Checkpoint* checkpoint = nullptr;
  std::string name = "render"; ///< Tells the renders of a program apart, see mc::RunOptions.
  mc::Executor executor = {};  ///< Who computes the units; empty: `threads` of this process.
};

/// Image and statistics of a render.
struct RenderResult {
  Image image;                  ///< Image, with variances if every pixel has at least two point sets.
  std::uint64_t samples = 0,    ///< Number of samples of pixels.
      rays = 0;                 ///< Number of rays, including light paths.
  double spp = 0;               ///< Mean number of samples per pixel.
  std::uint32_t estimates = 0;  ///< Number of independent point sets per pixel behind the variance.
  double seconds = 0,           ///< Wall-clock time [s].
      cpu_seconds = 0;          ///< CPU time [s].
  double relative_error = 0;    ///< RelativeError::value of the image.
  double worst_error = 0;       ///< RelativeError::value of the worst block.
  double outlier_dominated = 0; ///< Share of pixels with an unreliable error bar; see Film::outlier_dominated.
  std::uint64_t invalid = 0;    ///< Number of samples that were not finite; the image leaves them out.
  InvalidSample first_invalid;  ///< The first of them.
  bool partial = false;         ///< Whether the render was cancelled before the end.
  bool out_of_time = false;     ///< Whether the time ended before the target error was reached.
  /// Number of rows without samples after cancellation in the first round; they repeat the nearest rendered row.
  int missing_rows = 0;
};

/// Memory that a render by threads of one process needs beside the scene [bytes]: its film, its image, copies of a
/// checkpoint, and finished rows that wait for a row before them.
double memory_needed(const Scene& scene, const RenderOptions& options);

/// Renders a scene. For the same seed the result has the same bits for any number of threads. With `seconds` it depends
/// on the speed of the machine.
///   rounds  : each round doubles the samples of every pixel. After the first round, of two samples per pixel, the
///             image is complete and has variances. Cancelled in the first round, it has no variances, and missing rows
///             repeat the nearest rendered row. Rows are rendered far from each other to keep such gaps small.
///   point sets : the samples of a pixel are dealt to two independently randomised point sets. The variance between
///                sets is valid for low-discrepancy points. More sets would be shorter and less accurate, and
///                neighbouring pixels already add estimates of the variance.
///   light paths : their number belongs to the mean number of samples per pixel. They are dealt to the point sets, too.
///   adaptive : the first 16 samples per pixel, or about a quarter with `seconds` or `target_error`, are an even pilot,
///              which alone determines all later rates; see adaptive_plan(). From the third sample on the pilot also
///              tries how to trace paths, as far as the options leave it open: with one branch, with two, and in tiles;
///              see RendererChoice.
///   throws  : Error for a size, sample count, time or error that is not positive. Error for a crop that is not inside
///             the image. Error for options that exclude each other, and for a depth or number of branches out of
///             range. Error for a strategy that cannot find every light of the scene (finds_all_lights). MemoryError
///             where the pixels need more memory than is allowed.
RenderResult render(const Scene& scene, const RenderOptions& options);

} // namespace render
