#pragma once
/// Replicated Sobol' sequences that grow.

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/integration_run.h>

#include <cstdint>
#include <vector>

namespace mc::detail {

/// Replicated Sobol' sequences, extended from step to step.
struct ReplicatedSequences {
  std::uint64_t stream_id; ///< those of different stream ids are independent
  std::uint32_t count;     ///< of replicates
  Proposal proposal = {};  ///< with a density, its part of the mixture
  bool record = false;     ///< keeps what was seen with the sums
  std::uint64_t length = 0;
  std::vector<PointSet> sets = {};
  std::vector<Sums> sums = {};
  std::uint64_t points_per_uniform_point =
      8; ///< points for each one of the uniform part, once the sequences are extended
  std::uint64_t uniform_length = 0;
  std::vector<PointSet> uniform_sets = {};
  std::vector<Sums> uniform_sums = {};
  std::vector<Means> means_history = {};            ///< at each length, of the outputs that are not only watched
  Means means = {};                                 ///< the latest, of all
  std::vector<IntegrandDiagnostics> discarded = {}; ///< by sequences that were dropped
  std::vector<ReplicateHistory> histories = {};

  static constexpr std::uint64_t max_length = std::uint64_t{1} << 32;

  /// Calls per point of a replicate.
  double calls_per_point() const {
    return proposal.density ? 1 + 1 / static_cast<double>(points_per_uniform_point) : 1.0;
  }
  /// Calls of a replicate as long as it is now.
  std::uint64_t calls_per_replicate() const { return length + uniform_length; }
  /// How long the uniform part of so many points is; rounded up.
  std::uint64_t uniform_points(std::uint64_t points, std::uint64_t points_for_each) const {
    return proposal.density ? (points + points_for_each - 1) / points_for_each : 0;
  }
  /// The uniform part's share of the variance of the means; of several outputs the mean.
  double uniform_variance_share() const;
  /// The means once every sequence has `to` points.
  Means extend(IntegrationRun& run, std::uint64_t to);
  /// All values that were seen, also by sequences that were dropped, one per output.
  std::vector<IntegrandDiagnostics> diagnostics() const;
  /// Correlations of the means' errors.
  Correlations correlations(const IntegrationRun& run) const;
  /// The means with so many more sequences, as long as the others.
  Means add_replicates(IntegrationRun& run, std::uint32_t more);
  /// Drops all but the first sequences, but not the sizes of what the others saw.
  void keep_first(std::uint32_t first);
  /// Drops what was recorded.
  void discard_records();
};

/// Whether means of the same integrals lie too far apart for chance: one of them has not met what counts.
bool significantly_different(const Means& a, const Means& b);

/// Whether the error of some output is known from b and not from a, whose variance then says nothing, and of none the
/// other way round.
bool has_fewer_known_errors(const Means& a, const Means& b);

/// The logarithm of the variances of a over those of b, summed over the outputs. Of means that are apart the
/// relative errors count, and that of the smaller is at least the gap: the one that has not met what counts knows
/// neither its value nor its error.
double log_variance_ratio(const Means& a, const Means& b);

/// What such a logarithm must exceed for b to be the better: more the more skewed b is, since it looks too good where
/// few points met what counts.
double required_margin(const Means& b);

/// By how much the logarithm of the variances fell for each doubling, over the last three; the mean of the outputs.
double convergence_rate(const ReplicatedSequences& s);

/// The logarithm of the variance of a replicate of a over that of one of b, summed over the outputs, after `doublings`
/// more; both are as long. A dozen replicates know their variance badly, their points know well what it would be were
/// they independent: what replicates gain over that counts the less the less there is of it. And for each
/// doubling a gains as much as is `expected` of what each gained so far. Of means that are apart log_variance_ratio() counts.
double predicted_log_variance_ratio(const ReplicatedSequences& a, const ReplicatedSequences& b, double doublings,
                                    double expected);

} // namespace mc::detail
