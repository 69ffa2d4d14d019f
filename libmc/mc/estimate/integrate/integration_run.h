#pragma once
/// A run of integrate(): evaluates the integrand on point sets and accumulates sums.

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

/// Thrown inside a cancelled run; never leaves integrate().
struct Cancelled {};

/// Sampling density of points: uniform, a learned density p, or one part of a mixture with it.
///   all : The density p. A value is f / p.
///   density, uniform : A part of the mixture q = 7/8 p + 1/8 uniform. A value is (f - c p) / q, so no value exceeds 8
///                      f where p is too low. Its mean under q is the integral of f minus c. If f is close to c p, the
///                      mixture costs almost nothing [OwenZhou00].
struct Proposal {
  enum class Part { all, density, uniform };
  /// Share of the uniform part in the mixture.
  static constexpr double uniform_share = 0.125;

  std::shared_ptr<const AdaptedDensity> density = {}; ///< Null for uniform points.
  std::vector<double> control_coefficients = {};      ///< Coefficient c of each output.
  Part part = Part::all;                              ///< Part of the mixture.
};

/// An integrand with one or several outputs, for one or many points; exactly one pointer is set.
struct Integrand {
  const std::function<double(std::span<const double>)>* one = nullptr; ///< One output, one point.
  const VectorIntegrand* several = nullptr;                            ///< Several outputs, one point.
  const BatchIntegrand* batch = nullptr;                               ///< Many points.

  /// Whether the function is empty.
  bool empty() const {
    if (one) return !*one;
    if (several) return !*several;
    return !batch->f;
  }
  /// Evaluates points, with coordinates and values of each point in sequence.
  void operator()(std::span<const double> points, std::size_t dim, std::span<double> values) const;
};

/// Data kept in addition to the sums.
///   points  : Every point with its values of the primary outputs.
///   batches : Moments of 32 batches of values. Their means have the correlations of the errors.
enum class Keep { sums, points, batches };

/// Result of a round.
struct Round {
  Method method;                 ///< Method of the points.
  bool learning;                 ///< Whether a density was learned from the round.
  std::uint64_t calls;           ///< Evaluations of the run so far.
  Means means;                   ///< Means of the outputs.
  bool independent = false;      ///< Whether it is independent of the answer.
  std::vector<double> chi2 = {}; ///< For each output; NaN if there is nothing to compare.
};

/// State of a run: integrand, budget and clock.
struct IntegrationRun {
  Integrand integrand;             ///< Integrand.
  std::size_t outputs;             ///< Number of outputs.
  int dim;                         ///< Number of dimensions.
  const IntegrateOptions& options; ///< Settings.
  /// Start of the run.
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::uint64_t calls = 0;        ///< Evaluations so far.
  std::vector<Round> rounds = {}; ///< Results of all rounds.
  /// For each output, two bounds of a constant that is added to its tail and hides it; 0 if it may be 0 or if there is
  /// no tail. Estimated from the first points. One bound is the smallest value. The other lies below it by its distance
  /// to the upper quartile, where the constant of a sum with x^-1/2 lies. For a tail of negative values, uses the
  /// largest value and the lower quartile.
  std::vector<std::array<double, 2>> tail_offsets = {};
  /// Accumulated chi2 of each output.
  std::vector<double> chi2 = std::vector<double>(outputs), chi2_dof = std::vector<double>(outputs);

  /// Wall time since the start [s].
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  /// Evaluations left.
  std::uint64_t calls_left() const { return options.max_calls - calls; }
  /// Number of outputs that control stopping and adaptation.
  std::size_t primary_outputs() const { return outputs - options.auxiliary_outputs; }
  /// Largest number of points that may be recorded, with their values: 128 MB.
  std::uint64_t max_recorded_calls() const {
    return (std::uint64_t{1} << 24) / (static_cast<std::uint64_t>(dim) + primary_outputs());
  }

  /// Evaluates points [first, first + count) of each set. Returns one result per set, with the same bits for any number
  /// of threads.
  ///   throws : Error with the point if the integrand is not finite there. Cancelled.
  std::vector<Sums> evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                 const Proposal& proposal = {}, Keep keep = Keep::sums);

  /// Whether the baseline sequences (stream_id 0) are interlaced. Sequences mapped through a grid are not: interlacing
  /// helps smooth peaks but hurts integrands with jumps.
  bool uses_interlaced_points() const { return dim <= 2; }
  /// Point sets of replicates [first, last) of the stream `stream_id`.
  std::vector<PointSet> sobol_sets(std::uint64_t stream_id, std::uint32_t first, std::uint32_t last) const;

  /// Mean of every replicate for each output. If `uniform` is not empty, combines both parts of the mixture:
  /// `replicates` for the density part and `uniform` for the uniform part.
  std::vector<std::vector<double>> replicate_means(const std::vector<Sums>& replicates,
                                                   const std::vector<Sums>& uniform = {},
                                                   const Proposal& proposal = {}) const;
  /// Means over replicates of `points` points each. `histories` has one entry per output, or none before the first
  /// call. `discarded` are diagnostics of replicates that were dropped, because the tail of an output concerns all of
  /// its values.
  Means means(const std::vector<Sums>& replicates, std::uint64_t points, std::vector<ReplicateHistory>& histories,
              const std::vector<Sums>& uniform = {}, const Proposal& proposal = {},
              const std::vector<IntegrandDiagnostics>& discarded = {}) const;
  /// Adds a round to the history and reports progress.
  void record(Method method, const Means& means, bool learning = false);
  /// Marks the last round of a method as independent of the answer.
  void mark_independent(Method method);
  /// Adds the differences between a round and independent means to chi2.
  void add_chi2(Round& round, const Means& means);

  /// Whether all primary outputs satisfy a tolerance.
  bool converged(const Means& all) const;

 private:
  Sums evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const Proposal& proposal,
                Keep keep) const;
  void find_tail_offsets(const std::vector<Sums>& first);
  void record_points(Sums& sums, std::span<const double> points, std::span<const double> values) const;
  /// Throws NotFinite for `bad` of `count` points of the set; `first` is the index of the first bad point.
  [[noreturn]] void throw_not_finite(std::uint64_t bad, std::uint64_t count, std::uint64_t first, const PointSet& set,
                                     const Proposal& proposal) const;
};

} // namespace mc::detail
