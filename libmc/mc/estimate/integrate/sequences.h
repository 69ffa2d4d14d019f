#pragma once
/// Replicated Sobol' sequences that grow.

#include <mc/estimate/integrate/run.h>

#include <cstdint>
#include <vector>

namespace mc::detail {

/// Replicated Sobol' sequences, extended from step to step.
struct Sequences {
  std::uint64_t purpose;  ///< those of different purposes are independent
  Proposal proposal = {}; ///< with a grid, its part of the mixture
  std::uint64_t length = 0;
  std::vector<PointSet> sets = {};
  std::vector<Sums> sums = {};
  std::vector<PointSet> uniform_sets = {}; ///< of the uniform part, an eighth as long, rounded up
  std::vector<Sums> uniform_sums = {};
  std::vector<Means> history = {}; ///< at each length
  std::vector<Evidence> evidence = {};

  static constexpr std::uint64_t longest = std::uint64_t{1} << 32;

  /// Calls per point of a replicate.
  double cost() const { return proposal.grid ? 1 + Proposal::uniform_share : 1.0; }
  /// Calls of a replicate as long as it is now.
  std::uint64_t calls_each() const { return length + (proposal.grid ? (length + 7) / 8 : 0); }
  /// The means once every sequence has `to` points.
  Means extend(Run& run, std::uint64_t to);
  /// The values behind the means, one per output.
  std::vector<Magnitudes> seen() const;
  /// The means with `count` more sequences, as long as the others.
  Means widen(Run& run, std::uint32_t count);
};

/// By how much the errors of a will exceed those of b, a mean logarithm, after `doublings` more, if they go on
/// falling as they did over the last three.
double advantage(const Sequences& a, const Sequences& b, double doublings);

} // namespace mc::detail
