#pragma once
/// A run of integrate(): evaluates the integrand on sets of points and sums what it gives.

#include <mc/estimate/adapt/adapted_density.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/mean.h>
#include <mc/estimate/integrate/sums.h>
#include <mc/estimate/point_set.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mc::detail {

/// Thrown by a run that was cancelled; never leaves integrate().
struct Cancelled {};

/// What points are drawn from.
///   all : the density p that was learned; a value is f / p
///   a part of the mixture q = 7 / 8 p + 1 / 8 of that and the uniform density, so that no value exceeds 8 f where p is
///   wrong: a value is (f - c p) / q, whose mean under q is that of f but for c. Near c p, where p is right, the
///   mixture costs next to nothing [OwenZhou00].
struct Proposal {
  enum class Part { all, density, uniform };
  static constexpr double uniform_share = 0.125;

  std::shared_ptr<const AdaptedDensity> density = {}; ///< none: uniform
  std::vector<double> control_coefficients = {};      ///< c of each output
  Part part = Part::all;
};

/// One value or several, of one point or many.
struct Integrand {
  const std::function<double(std::span<const double>)>* one = nullptr;
  const VectorIntegrand* several = nullptr;
  const BatchIntegrand* batch = nullptr;

  bool empty() const {
    if (one) return !*one;
    if (several) return !*several;
    return !batch->f;
  }
  /// The values at points, both one after the other.
  void operator()(std::span<const double> points, std::size_t dim, std::span<double> values) const;
};

/// What is kept of an evaluation beside the sums.
///   points  : every point, with the values that are not only watched
///   batches : the moments of 32 batches of the values, whose means correlate as the errors do
enum class Keep { sums, points, batches };

/// What a round found.
struct Round {
  Method method;
  bool learning;
  std::uint64_t calls; ///< of the run, so far
  Means means;
  bool independent = false;      ///< of the answer
  std::vector<double> chi2 = {}; ///< of each output; not a number where nothing was compared
};

/// The integrand, the budget, the clock.
struct IntegrationRun {
  Integrand integrand;
  std::size_t outputs;
  int dim;
  const IntegrateOptions& options;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t calls = 0;
  std::vector<Round> rounds = {};
  /// Of each output the constant that its tail, if it has one, is added to and hidden by, between two bounds as the
  /// first points show it: the least value, or as far below it as the upper quartile is above, where that of a sum with
  /// x^-1/2 is; or the other way round. 0 where it may be 0, or where there is no tail.
  std::vector<std::array<double, 2>> tail_offsets = {};
  std::vector<double> chi2 = std::vector<double>(outputs), chi2_dof = std::vector<double>(outputs);

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  std::uint64_t calls_left() const { return options.max_calls - calls; }
  /// Outputs that are not only watched.
  std::size_t primary_outputs() const { return outputs - options.auxiliary_outputs; }
  /// Calls that may be recorded: 128 MB of points and values.
  std::uint64_t max_recorded_calls() const {
    return (std::uint64_t{1} << 24) / (static_cast<std::uint64_t>(dim) + primary_outputs());
  }

  /// Points [first, first + count) of each set; one result per set, with the same bits for any number of threads.
  ///   throws : Error where the integrand is not finite, with the point; Cancelled
  std::vector<Sums> evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                 const Proposal& proposal = {}, Keep keep = Keep::sums);

  /// Whether the baseline sequences, those of stream_id 0, are interlaced. Under a grid they are not: smooth peaks would gain
  /// by it, but integrands that jump would lose.
  bool uses_interlaced_points() const { return dim <= 2; }
  /// Replicates [first, last) of the sequences for a stream_id.
  std::vector<PointSet> sobol_sets(std::uint64_t stream_id, std::uint32_t first, std::uint32_t last) const;

  /// For each output the mean of every replicate. `uniform` are the sums of the uniform part where the replicates are
  /// those of the other part of a mixture.
  std::vector<std::vector<double>> replicate_means(const std::vector<Sums>& replicates,
                                                   const std::vector<Sums>& uniform = {},
                                                   const Proposal& proposal = {}) const;
  /// The means of replicates of so many points each; `histories` holds one entry per output, or none at first;
  /// `discarded` are values of replicates that were dropped: the tail of an output is that of all values.
  Means means(const std::vector<Sums>& replicates, std::uint64_t points, std::vector<ReplicateHistory>& histories,
              const std::vector<Sums>& uniform = {}, const Proposal& proposal = {},
              const std::vector<IntegrandDiagnostics>& discarded = {}) const;
  /// Records a round, and reports the progress.
  void record(Method method, const Means& means, bool learning = false);
  /// Notes that the last round of a method is independent of the answer.
  void mark_independent(Method method);
  /// Adds to chi2 how far a round lies from means that are independent of it.
  void add_chi2(Round& round, const Means& means);

  bool converged(const Means& all) const;

 private:
  Sums evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const Proposal& proposal,
                Keep keep) const;
  void find_tail_offsets(const std::vector<Sums>& first);
  void record_points(Sums& sums, std::span<const double> points, std::span<const double> values) const;
  /// Throws: so many of `count` points of the set were bad, the one of index `first` the first.
  [[noreturn]] void throw_not_finite(std::uint64_t bad, std::uint64_t count, std::uint64_t first, const PointSet& set,
                                     const Proposal& proposal) const;
};

} // namespace mc::detail
