#pragma once
/// Evaluates an integrand at point sets, in chunks on several threads. Knows nothing of statistics.

#include <mc/estimate/integrate.h>
#include <mc/estimate/integrate/learn_density.h>
#include <mc/estimate/integrate/sums.h>
#include <mc/estimate/point_set.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace mc::detail {

/// Thrown when IntegrateOptions::cancel became true; never leaves integrate().
struct Cancelled {};

/// An integrand with one output or several, called for single points or for batches.
struct Integrand {
  const std::function<double(std::span<const double>)>* one = nullptr; ///< One output, one point.
  const VectorIntegrand* several = nullptr;                            ///< Several outputs, one point.
  const BatchIntegrand* batch = nullptr;                               ///< Several outputs, many points.

  /// Whether the function that is set is empty.
  bool empty() const {
    if (one) return !*one;
    if (several) return !*several;
    return !batch->f;
  }
  /// Largest number of points of a call.
  std::size_t max_points() const { return batch ? batch->max_points : 1; }
  /// Fills `values`, output by output for each point, from points of `dim` coordinates each.
  void operator()(std::span<const double> points, std::size_t dim, std::span<double> values) const;
};

/// What an evaluation keeps besides moments and extreme values.
struct Keep {
  bool batches = false;                  ///< Moments of 32 batches.
  Record* record = nullptr;              ///< Receives the first points of each set ...
  std::uint64_t most_recorded = 1 << 18; ///< ... at most so many in all.
};

/// Evaluates the integrand of one call of integrate(), and counts the calls.
struct Evaluator {
  Integrand integrand;             ///< The integrand.
  std::size_t outputs;             ///< Number of outputs.
  int dim;                         ///< Dimension of the cube.
  const IntegrateOptions& options; ///< Threads and cancellation.
  std::uint64_t calls = 0;         ///< Evaluations so far.

  /// Number of outputs that determine the end and the density.
  std::size_t primary() const { return outputs - options.auxiliary_outputs; }
  /// Calls that are left.
  std::uint64_t remaining() const { return options.max_calls - std::min(calls, options.max_calls); }
  /// Points [first, first + count) of each set. Returns one result per set; it has the same bits for any number of
  /// threads. `before` are earlier values, of each output or none: less extreme ones are not kept again.
  ///   throws : NotFinite where the integrand is not a number, or infinite on more than a thousandth of the volume;
  ///            Cancelled.
  std::vector<Sums> evaluate(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                             const Proposal& proposal = {}, Keep keep = {},
                             const std::vector<SampledValues>& before = {});

 private:
  class EvaluateJob;
  // Points [first, last) of a set, of which the first `recorded` belong to the record, from `place` on.
  struct Chunk {
    std::uint64_t first, last, recorded, place;
  };
  Sums evaluate_chunk(const PointSet& set, Chunk range, const Proposal& proposal, Keep keep,
                      const std::vector<SampledValues>& empty) const;
  [[noreturn]] void throw_not_finite(std::uint64_t bad, std::uint64_t count, std::uint64_t index, const PointSet& set,
                                     const Proposal& proposal) const;
};

} // namespace mc::detail
