#pragma once
/// Measures the error of a scene's pictures against samples and seconds, for several render methods.

#include <converge/trade.h>

#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <deque>

namespace carlo {

/// How samples are distributed over pixels.
enum class SampleAllocation {
  uniform,
  adaptive, ///< more samples where the error is larger
  splat,    ///< evenly, each sample added to all pixels under the filter
  tiles,    ///< evenly, blocks of 2x2 pixels share paths
  adaptive_tiles
};

inline bool is_adaptive(SampleAllocation s) {
  return s == SampleAllocation::adaptive || s == SampleAllocation::adaptive_tiles;
}
inline bool uses_tiles(SampleAllocation s) {
  return s == SampleAllocation::tiles || s == SampleAllocation::adaptive_tiles;
}

/// A combination of strategy, sampler, path length and sample allocation.
struct RenderMethod {
  render::Strategy strategy = render::strategy_from("mis+lt");
  render::PixelSampler sampler = render::PixelSampler::sobol;
  int max_depth = -1; ///< longest path in edges; -1: no limit
  SampleAllocation allocation = SampleAllocation::uniform;

  /// "mis sobol", "nee independent depth 4 adaptive", "mis sobol splat", "mis sobol adaptive tiles".
  std::string name() const;
};

/// Plain Monte Carlo: independent samples of BSDF-sampled paths that hit lights by chance. Nothing if such paths cannot
/// hit every light.
std::optional<RenderMethod> plain_mc_method(const render::SceneFile& file);

struct PictureOptions {
  int width = 64, height = 64;
  int max_spp = 64;
  int replicates = 0;     ///< pictures behind each error; 0: 8 to 64, enough for a relative error of 10 %
  bool cost_rays = false; ///< reports cost in millions of rays, which is the same on every machine, instead of seconds
  double seconds = 0;     ///< wall-clock; the run ends where twice as many samples would not fit; 0: at max_spp
  std::uint64_t seed = 1;
  int threads = 0;
  const std::atomic<bool>* cancel = nullptr;
  mc::Checkpoint* checkpoint = nullptr; ///< saves and restores pictures and errors
  mc::Executor executor = {};           ///< who renders; empty: threads
  std::function<void(double done, const std::string& where)> progress = {};
};

/// The systematic error of a method, which does not decrease with samples: paths that are too short, or light that a
/// strategy does not sample.
struct Bias {
  IntervalEstimate bias; ///< root of the relmse of the expected picture. The 95 % interval holds simultaneously for all
                         ///< methods. It treats the spread between pixels as random, so a bias is significant only if
                         ///< many pixels show it.
  double noise = 0;      ///< root of the relmse of one picture's noise
  double n = 0;          ///< largest number of samples per pixel
  /// Error above which a method with a significant bias costs less than the best method without one. Infinite if the
  /// method may cost more at any error; nothing if it does cost more. The interval is simultaneous like the bias
  /// interval.
  std::optional<IntervalEstimate> break_even_error;
};

/// The errors of all methods. N is samples per pixel. The error of a picture is the root of its relmse.
///   relmse : mean over pixels and channels of (x - reference)^2 / (reference^2 + mean^2 / 10), minus the contribution
///            of the reference's noise.
///   mean   : over the pixels and channels of the first reference, the same for every method, so that errors do not
///            depend on the unit of light.
struct PictureMeasurement {
  std::deque<SamplingMethod> methods; ///< the curves point to these
  Measurement measurement;            ///< its truth is an error of 0
  std::vector<Bias> biases;           ///< one for each method
  render::Image reference;
  std::vector<render::Image> pictures; ///< one for each method, with its largest number of samples
  double reference_error = 0;          ///< root of the relmse caused by the noise of the reference
  double reference_spp = 0;
  std::string missing_light; ///< light that no picture shows, nor the reference; see missing_light_text()
  std::string cut_short;     ///< why memory ended the run before max_spp; empty: it did not
};

/// Runs every method with 4, 8, ... max_spp samples per pixel (adaptive ones from 32). The methods take turns, so that
/// other load on the machine affects all of them. The 95 % intervals of the errors use Student's t over the pictures.
/// An error that is not significantly larger than the reference's is a bound. After an interrupt the result contains
/// the finished levels and the methods with at least one.
///   theory    : N^-1/2 for independent samples, spent evenly, without a significant bias.
///   reference : mis+lt, sobol and the scene's longest path; at each level its samples grow until its error is a tenth
///               of the smallest mean noise of a method.
///   memory    : all pictures of the last two levels, with their variances. A level that needs more than is allowed
///               ends the run.
///   throws    : Error for a black scene, no methods, fewer than 3 pictures, or max_spp below 16 or above 2^28.
///               MemoryError before any work for more pictures than the memory allows.
PictureMeasurement measure_pictures(const render::SceneFile& file, const std::vector<RenderMethod>& methods,
                                    const PictureOptions& options);

} // namespace carlo
