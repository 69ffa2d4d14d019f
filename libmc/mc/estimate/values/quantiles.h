#pragma once
/// Quantiles of the values of a function.

#include <mc/estimate/estimate.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mc {

/// Settings of quantiles().
struct QuantileOptions {
  /// Upper limit for the number of evaluations; rounded down to a multiple of `replicates`.
  std::uint64_t calls = 98'304;
  std::uint32_t replicates = 24; ///< Number of independent randomisations.
  std::uint64_t seed = 1;        ///< Seed of all random numbers.
  int threads = 0; ///< Number of threads, 0 for all hardware threads. The result has the same bits for any number.
  double confidence = 0.95;                  ///< Confidence level of the intervals.
  const std::atomic<bool>* cancel = nullptr; ///< Cancels the computation when it becomes true.
};

/// A quantile and its confidence interval.
struct Quantile {
  double probability;          ///< Probability of values up to the quantile.
  double value;                ///< The least t with P(f <= t) >= probability.
  Estimate::Interval interval; ///< Interval of the quantile; infinite on a side that the samples cannot bound.
};

/// Quantiles of f(u), u uniform in [0,1)^dim, from independently scrambled Sobol' sequences.
///   interval : All t for which P(f <= t) agrees with the probability. That share is a mean over replicates with its
///              own interval. If single values of f have positive probability, the interval contains the true quantile.
///   throws   : Error for an empty f, dim < 1, no probability, or a probability outside (0, 1). Error for fewer than
///              two calls per replicate, more values than fit into 128 MB, or if cancelled. NotFinite with the point
///              for a non-finite value of f.
std::vector<Quantile> quantiles(const std::function<double(std::span<const double>)>& f, int dim,
                                std::span<const double> probabilities, const QuantileOptions& options = {});

} // namespace mc
