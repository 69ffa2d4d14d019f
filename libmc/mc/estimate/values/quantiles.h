#pragma once
/// Which values a function takes, and how often.

#include <mc/estimate/estimate.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mc {

struct QuantileOptions {
  std::uint64_t calls = 98'304; ///< of the function, at most; a multiple of the replicates is used
  std::uint32_t replicates = 24;
  std::uint64_t seed = 1;
  int threads = 0; ///< 0: all of the machine's; the result has the same bits for any number
  double confidence = 0.95;
  const std::atomic<bool>* cancel = nullptr; ///< ends the work once it is true
};

struct Quantile {
  double probability;
  double value;                ///< the least that f stays at or below with this probability
  Estimate::Interval interval; ///< of the value; an end is infinite where the calls cannot tell
};

/// Quantiles of f(u), u uniform in [0,1)^dim, from independently scrambled Sobol' sequences.
///   interval : all values t whose share of points at or below them, a mean of replicates with an interval of its own,
///              agrees with the probability; measured over random integrands it holds the true quantile as often as
///              `confidence` says. Of values that f takes with a probability of their own, the true one is within
///   throws   : Error for an empty f, dim < 1, no probability or one outside (0, 1), fewer calls than two for each
///              replicate or more values than fit into 128 MB, where f is not finite, with the point, and when
///              cancelled
std::vector<Quantile> quantiles(const std::function<double(std::span<const double>)>& f, int dim,
                                std::span<const double> probabilities, const QuantileOptions& options = {});

} // namespace mc
