#pragma once
/// Statistical tests of anything that draws points with a claimed density.

#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <functional>

namespace mc {

/// Options of the statistical tests.
struct SubjectOptions {
  std::uint64_t samples = 1'000'000; ///< number of counted samples; pilot_samples(samples) more choose the cells
  std::uint64_t seed = 1;            ///< seed of all random numbers
  /// Probability that a correct subject fails, over all its statistical tests. With the default, a suite of a hundred
  /// correct distributions passes nine times in ten.
  double alpha = 0.001;
  /// Largest number of evaluations of the density. The expected counts use at most a third of it.
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false; ///< keep all counts and intermediate p-values, for pages and plots
  /// Accept faults of measure zero: sample may fail at single values of u, and pdf may be 0 or infinite on boundaries
  /// of the domain.
  bool open_interval = false;
  /// Called before each batch of draws; an exception that it throws ends the check.
  const std::function<void()>* before_draws = nullptr;
};

/// Returns the statistical part of LawOptions or BsdfOptions. Both structs repeat its members, so that callers can
/// write {.samples = n}.
template <class Options> SubjectOptions statistics(const Options& o) {
  return {o.samples, o.seed, o.alpha, o.max_evaluations, o.evidence, o.open_interval, o.before_draws};
}
/// Returns `o` with its statistical part replaced by `s`.
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

/// Draws samples and tests them:
///   per sample : the sample is finite and in the domain, its pdf is positive and finite, a stated weight is f / pdf.
///                Failures occur only if the subject may fail.
///   mass       : the claimed density and the atoms integrate to 1; to at most 1 if the subject may fail. The integral
///                comes from cubature if random points and samples agree with it. Its error then includes the mass that
///                4.6 samples would miss. Otherwise the integral and its error come from the random points.
///   counts     : all tests of cell_tests.h, on cells adapted to the density. The variance of the expected counts
///                (stratified_reference.h) is part of the tests, so that no density makes a correct sampler fail.
///   marginals  : thin bins along each axis, down to a few samples per bin at the ends (marginal_bins.h).
///   density    : counts of samples by the ratio of the density to its average nearby (density_ratio.h).
///   waves      : Fourier coefficients of the counts on a fine grid of the chart, and of the inverted samples
///                (spectrum.h).
///   inverted   : the images of at most 131072 samples under invert are uniform, if the subject has an inverse
///                (uniformity.h).
///   atoms      : the most frequent value of each coordinate, against the mass of its interval (axis_intervals.h).
///   gaps       : the widest gap between samples on each axis, inside and at the ends, against its mass
///                (axis_intervals.h).
/// The report states the smallest errors of the density that are detected with probability .99.
///   throws     : Error if samples < 1000, or if alpha is not in (0, 1).
Report check_subject(const Subject& subject, const SubjectOptions& options = {});

/// Memory that check_subject needs for two dimensions or three [bytes]; one dimension needs less. It is bounded for any
/// number of samples.
double check_memory(std::uint64_t samples);

/// Returns the number of samples with which check_subject detects a relative error `error` of the density, of random
/// sign (see Report), with probability .99. `alpha` is family-wise, `dim` is the dimension of the chart; more
/// dimensions need more samples. Throws Error unless error > 0 and 0 < alpha < 1.
std::uint64_t samples_to_detect(double error, double alpha, int dim = 3);

} // namespace mc
