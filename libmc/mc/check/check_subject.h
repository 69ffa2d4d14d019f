#pragma once
/// The laws of anything that draws points with a claimed density.

#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <functional>

namespace mc {

struct SubjectOptions {
  std::uint64_t samples = 1'000'000; ///< counted; pilot_samples(samples) more are drawn for the bins
  std::uint64_t seed = 1;
  double alpha = 0.001; ///< chance that a correct subject is rejected, over all its statistical tests. The default
                        ///< lets a suite of a hundred samplers pass nine seeds in ten
  std::size_t max_evaluations = 12'000'000; ///< of the density; a third of it at most for the expected counts
  bool evidence = false;                    ///< keep all counts and the p-value's way, for pages and plots
  bool open_interval = false; ///< u in (0,1): the sampler may break at single u, its density on the domain's edge
  const std::function<void()>* before_draws = nullptr; ///< called again and again; what it throws ends the check
};

/// The statistical part of the options of laws and BSDFs, which stands flat in them so that users write {.samples = n}.
template <class Options> SubjectOptions statistics(const Options& o) {
  return {o.samples, o.seed, o.alpha, o.max_evaluations, o.evidence, o.open_interval, o.before_draws};
}
/// Those options with another statistical part.
template <class Options> Options with_statistics(Options o, const SubjectOptions& s) {
  o.samples = s.samples;
  o.seed = s.seed;
  o.alpha = s.alpha;
  o.max_evaluations = s.max_evaluations;
  o.evidence = s.evidence;
  o.open_interval = s.open_interval;
  o.before_draws = s.before_draws;
  return o;
}

/// Draws and tests:
///   per sample : finite, in the domain, pdf positive and finite, stated weight = f / pdf; failures only where allowed
///   mass       : the claimed density and atoms integrate to 1 (to at most 1, the rest failing, where failures are
///                allowed): by cubature where random points and the samples agree with it, to the error of the cubature
///                and what 4.6 samples would not have seen; else to the error of the random points
///   counts     : all tests of cell_tests.h on cells adapted to the density, whose probabilities are known with their
///                variance (stratified_reference.h), so that no density makes a right sampler fail
///   marginals  : thin layers along each axis, down to a few samples at the ends (marginal_bins.h)
///   density    : how many samples lie where the density is high or low against its surroundings (density_ratio.h)
///   waves      : Fourier coefficients of the counts on a fine grid of the chart, and of the inverted samples
///                (spectrum.h)
///   inverted   : the sampler's own inverse, where it has one, makes samples uniform, at most 131072 (uniformity.h)
///   atoms      : the place on each axis where most samples agree, against the mass of its interval (axis_intervals.h)
///   gaps       : the widest gap between samples inside each axis and at its ends, likewise
///   detection  : the report states the smallest errors it would have caught with probability .99
///   throws     : Error when samples < 1000, or alpha is not in (0, 1)
Report check_subject(const Subject& subject, const SubjectOptions& options = {});

/// Samples at which check_subject catches a density whose relative error is `error`, of random sign (see Report),
/// with probability .99 at family-wise alpha, of a density in `dim` dimensions: the more, the more samples it takes.
/// Throws Error unless 0 < error and 0 < alpha < 1.
std::uint64_t samples_to_detect(double error, double alpha, int dim = 3);

} // namespace mc
