#pragma once
/// Replicated Sobol' sequences of increasing length.

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/integration_run.h>

#include <cstdint>
#include <vector>

namespace mc::detail {

/// Replicated Sobol' sequences that are extended step by step.
struct ReplicatedSequences {
  std::uint64_t stream_id; ///< Sequences of different stream ids are independent.
  std::uint32_t count;     ///< Number of replicates.
  /// Density of the points. If it is learned, the sequences draw the density part of the mixture.
  Proposal proposal = {};
  bool record = false;             ///< Whether to keep points and values.
  std::uint64_t length = 0;        ///< Number of points of each replicate.
  std::vector<PointSet> sets = {}; ///< Point sets of the replicates.
  std::vector<Sums> sums = {};     ///< Sums of the replicates.
  /// Number of points for each point of the uniform part; applies from the next extension on.
  std::uint64_t points_per_uniform_point = 8;
  std::uint64_t uniform_length = 0;                 ///< Number of points of the uniform part of each replicate.
  std::vector<PointSet> uniform_sets = {};          ///< Point sets of the uniform part.
  std::vector<Sums> uniform_sums = {};              ///< Sums of the uniform part.
  std::vector<Means> means_history = {};            ///< Means of the primary outputs at each length.
  Means means = {};                                 ///< Latest means of all outputs.
  std::vector<IntegrandDiagnostics> discarded = {}; ///< Diagnostics of sequences that were dropped.
  std::vector<ReplicateHistory> histories = {};     ///< History of each output.

  /// Largest length of a sequence.
  static constexpr std::uint64_t max_length = std::uint64_t{1} << 32;

  /// Evaluations per point of a replicate, with its uniform part.
  double calls_per_point() const {
    return proposal.density ? 1 + 1 / static_cast<double>(points_per_uniform_point) : 1.0;
  }
  /// Evaluations of one replicate of the current length.
  std::uint64_t calls_per_replicate() const { return length + uniform_length; }
  /// Number of points of the uniform part for `points` points, rounded up.
  std::uint64_t uniform_points(std::uint64_t points, std::uint64_t points_for_each) const {
    return proposal.density ? (points + points_for_each - 1) / points_for_each : 0;
  }
  /// Share of the uniform part in the variance of the means, averaged over the outputs.
  double uniform_variance_share() const;
  /// Extends every sequence to `to` points and returns the means.
  Means extend(IntegrationRun& run, std::uint64_t to);
  /// Diagnostics of all values, including values of dropped sequences, one per output.
  std::vector<IntegrandDiagnostics> diagnostics() const;
  /// Correlations of the errors of the means.
  Correlations correlations(const IntegrationRun& run) const;
  /// Adds `more` sequences of the current length and returns the means.
  Means add_replicates(IntegrationRun& run, std::uint32_t more);
  /// Drops all but the first sequences, but keeps the diagnostics of the dropped ones.
  void keep_first(std::uint32_t first);
  /// Drops recorded points and values.
  void discard_records();
};

/// Whether means of the same integrals differ by more than chance. One of them then missed an important region.
bool significantly_different(const Means& a, const Means& b);

/// Whether b has a known error for some output where a has not, and never the other way round. The variance of a is
/// then meaningless.
bool has_fewer_known_errors(const Means& a, const Means& b);

/// Logarithm of the variances of a over the variances of b, summed over the outputs. For significantly different means,
/// compares relative errors and takes the error of the smaller mean as at least the difference. That mean missed an
/// important region, so its own error is wrong.
double log_variance_ratio(const Means& a, const Means& b);

/// Minimum of log_variance_ratio(a, b) for which b counts as better. Increases with the skewness of b, because b looks
/// too good if few of its points reach the important region.
double required_margin(const Means& b);

/// Mean decrease of the log variance per doubling, over the last three doublings and all outputs.
double convergence_rate(const ReplicatedSequences& s);

/// Predicted log ratio of the variances of one replicate of a and of b after `doublings` further doublings, summed over
/// the outputs; both have equal length. The variance of a dozen replicates is inaccurate, but the variance for
/// independent points is accurate. The gain over independent points is therefore damped, more strongly if it is small.
/// For each doubling, a gains `expected` times its mean gain so far. For significantly different means, uses
/// log_variance_ratio().
double predicted_log_variance_ratio(const ReplicatedSequences& a, const ReplicatedSequences& b, double doublings,
                                    double expected);

} // namespace mc::detail
