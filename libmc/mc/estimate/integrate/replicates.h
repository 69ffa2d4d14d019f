#pragma once
/// Independent randomisations of one point set, with their means.

#include <mc/estimate/integrate/run.h>

#include <cstdint>
#include <vector>

namespace mc::detail {

/// Replicates that grow: scrambled Sobol' sequences of equal length, through one proposal.
class Replicates {
 public:
  static constexpr std::uint64_t first_length = 64; ///< Shortest length.

  /// `count` sequences of a round of a stream.
  Replicates(Run& run, Stream stream, std::uint64_t round, std::uint32_t count, Proposal proposal = {})
      : run_(&run), stream_(stream), round_(round), count_(count), proposal_(std::move(proposal)) {}

  /// Extends every sequence to this length, and returns the means. The added points may be recorded.
  const Means& extend(std::uint64_t length, bool record = false);
  /// Adds sequences of the present length, and returns the means.
  const Means& add(std::uint32_t more);
  /// Drops all but the first sequences; the extremes of their values stay.
  void keep_first(std::uint32_t count);

  /// Length of each sequence.
  std::uint64_t length() const { return length_; }
  /// Number of sequences.
  std::uint32_t count() const { return count_; }
  /// Calls of the present length.
  std::uint64_t calls() const { return length_ * count_; }
  /// Means at the present length.
  const Means& means() const { return means_; }
  /// Smallest rate at which the spread of a primary output falls with the length.
  double rate() const;
  /// The outcome at the present length.
  Outcome outcome(Method method) const;
  /// Points, values and weights that the last extension has recorded.
  const Record& record() const { return record_; }
  /// Through which the points are drawn.
  const Proposal& proposal() const { return proposal_; }

 private:
  void absorb(std::vector<Sums>&& more, std::size_t first);
  void measure();
  std::vector<std::vector<double>> replicate_means() const;

  Run* run_;
  Stream stream_;
  std::uint64_t round_;
  std::uint32_t count_;
  Proposal proposal_;
  std::uint64_t length_ = 0;
  std::vector<Sums> sums_;             // of each sequence, without sampled values and records
  std::vector<SampledValues> sampled_; // of each output, over all sequences
  std::vector<SpreadHistory> histories_;
  std::vector<std::uint64_t> infinite_;
  Record record_;
  Means means_;
};

} // namespace mc::detail
