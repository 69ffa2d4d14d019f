#pragma once
/// Error of a scene's pictures against samples and seconds, for several ways to render it.

#include <converge/trade.h>

#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <deque>

namespace carlo {

/// How samples become pixels.
enum class SampleAllocation {
  uniform,
  adaptive, ///< samples where the error is
  splat,    ///< evenly, each sample for all pixels under the filter
  tiles,    ///< evenly, 2x2 pixels share paths
  adaptive_tiles
};

inline bool is_adaptive(SampleAllocation s) {
  return s == SampleAllocation::adaptive || s == SampleAllocation::adaptive_tiles;
}
inline bool uses_tiles(SampleAllocation s) {
  return s == SampleAllocation::tiles || s == SampleAllocation::adaptive_tiles;
}

/// One way to render.
struct RenderMethod {
  render::Strategy strategy = render::strategy_from("mis+lt");
  render::PixelSampler sampler = render::PixelSampler::sobol;
  int max_depth = -1; ///< longest path in edges; -1: no limit
  SampleAllocation allocation = SampleAllocation::uniform;

  /// "mis sobol", "nee independent depth 4 adaptive", "mis sobol splat", "mis sobol adaptive tiles".
  std::string name() const;
};

/// Plain Monte Carlo: independent samples of paths that follow the surfaces and meet the lights by chance. Nothing
/// where chance does not meet every light.
std::optional<RenderMethod> plain_mc_method(const render::SceneFile& file);

struct PictureOptions {
  int width = 64, height = 64;
  int max_spp = 64;
  int replicates = 0;     ///< pictures behind each error; 0: as many as make it known to 10 %, 8 to 64
  bool cost_rays = false; ///< a second is a million rays: the same on every machine
  double seconds = 0;     ///< wall-clock: no more samples where twice as many would not fit; 0: until max_spp
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(double done, const std::string& where)> progress = {};
};

/// What a way errs by however long it runs: paths that are too short, light that a strategy does not look for.
struct Bias {
  IntervalEstimate
      bias;         ///< root of the relmse of its expectation; the interval holds for all ways at once with 95 %, and
                    ///< counts the spread between pixels as chance, so that a bias is told by many of them
  double noise = 0; ///< root of the relmse of one picture's noise
  double n = 0;     ///< samples per pixel, the most
  /// Where it is told from 0: the error above which it costs less than the best way without. Infinite where it may cost
  /// more at any error, nothing where it does. The interval holds like that of the bias.
  std::optional<IntervalEstimate> break_even_error;
};

/// What was measured: N is samples per pixel, the error of a picture the root of its relmse, the mean over pixels and
/// channels of (x - reference)^2 / (reference^2 + mean^2 / 10), less what the noise of the reference adds; mean: over
/// the pixels and channels of the first reference, for every way, so that errors do not depend on the unit of light.
struct PictureMeasurement {
  std::deque<SamplingMethod> methods; ///< that the curves point to
  Measurement measurement;            ///< its truth is an error of 0
  std::vector<Bias> biases;           ///< of the ways
  render::Image reference;
  std::vector<render::Image> pictures; ///< one of each way, of its most samples
  double reference_error = 0;          ///< root of the relmse that the reference's noise is
  double reference_spp = 0;
};

/// Every way on 4, 8, ... max_spp samples per pixel (adaptive ones from 32), taken in turn, so that a busy moment falls
/// on all of them. 95 % intervals of the errors by Student's t over the pictures; an error that is not told from the
/// reference's is a bound. When interrupted, what was measured
/// with fewer samples is kept; the ways that were begun are those of the result.
///   theory    : N^-1/2 for independent samples, spent evenly, whose bias is not told from 0
///   reference : mis+lt, sobol and the scene's longest path; at each number of samples so many more as bring its
///               error to a tenth of the smallest by noise
///   throws    : Error for a black scene, no ways, fewer than 3 pictures, or max_spp below 16 or above 2^28
PictureMeasurement measure_pictures(const render::SceneFile& file, const std::vector<RenderMethod>& methods,
                                    const PictureOptions& options);

} // namespace carlo
