#pragma once
/// One call of integrate(): the evaluator, the wanted error and the rounds so far.

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/error_bar.h>
#include <mc/estimate/integrate/evaluate.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mc::detail {

/// Independent streams of random numbers. A stream has rounds, and a round has replicates.
enum class Stream : std::uint64_t { rqmc, stratified, adapted, quantiles };

/// Result of a method, and of each of its rounds.
struct Outcome {
  Means means;                                        ///< Mean of each output.
  Method method;                                      ///< Method of the means.
  StopReason stop = StopReason::max_calls;            ///< Reason for the end.
  Correlations correlations = {};                     ///< Correlations of the errors.
  std::vector<std::uint64_t> infinite = {};           ///< Infinite values of each output.
  std::shared_ptr<const AdaptedDensity> density = {}; ///< Density that was learned, if any.
};

/// Record of one round.
struct Round {
  Method method;              ///< Method of the points.
  bool learning;              ///< Whether a density was learned from it.
  std::uint64_t calls;        ///< Calls of the run so far.
  Means means;                ///< Mean of each output.
  bool independent = false;   ///< Independent of the answer, so that the two can be compared.
  std::vector<double> chi2{}; ///< Squared normal deviate from the answer, per output.

  /// Computes chi2 for an answer that is independent of the round.
  void compare(const Means& answer);
};

/// State of one call of integrate().
struct Run {
  Evaluator evaluator;                           ///< Evaluates the integrand.
  const Tuning& tuning = detail::default_tuning; ///< Constants of the error bar.
  std::vector<Round> rounds = {};                ///< All rounds so far.
  std::optional<Outcome> last = {};              ///< Answer if the run is cancelled now.
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now(); ///< Begin.

  /// Options of the call.
  const IntegrateOptions& options() const { return evaluator.options; }
  /// Seconds since the begin.
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
  /// Number of outputs that determine the end and the density.
  std::size_t primary() const { return evaluator.primary(); }
  /// Whether the points of a stream are interlaced.
  bool interlaced(Stream stream) const { return stream == Stream::rqmc && evaluator.dim <= 2; }
  /// Point sets of replicates [begin, end) of a round of a stream: interlaced Sobol' points for rqmc in up to two
  /// dimensions, else scrambled ones. Those of rqmc are warped; the bins of a learned density are aligned with the net.
  std::vector<PointSet> sobol_sets(Stream stream, std::uint64_t round, std::uint32_t begin, std::uint32_t end) const;
  /// Records a round, and reports the progress.
  void record(Method method, const Means& means, bool learning = false);
  /// Standard error at which an output has converged.
  double wanted_error(const Mean& mean) const {
    return std::max(options().abs_error, options().rel_error * std::abs(mean.value));
  }
  /// Whether every primary output has the wanted error, after at least min_calls calls.
  bool converged(const Means& means) const;
  /// Factor by which the errors of the primary outputs exceed the wanted ones; infinite if one is not known or 0 is
  /// wanted, below 1 if all are reached.
  double excess(const Means& means) const;
};

} // namespace mc::detail
