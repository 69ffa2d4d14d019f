#pragma once
/// The methods of integrate().

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/integration_run.h>
#include <mc/estimate/integrate/replicated_sequences.h>

#include <optional>
#include <vector>

namespace mc::detail {

/// The outcome so far, good for an answer when the run is cancelled.
struct Outcome {
  Means means;
  Method method;
  StopReason stop = StopReason::max_calls;
  std::vector<IntegrandDiagnostics> diagnostics = {}; ///< the values behind the means, one per output
  Correlations correlations = {};                     ///< of the means' errors
  std::shared_ptr<const AdaptedDensity> density = {}; ///< that was learned
};

/// Independent points.
Outcome plain(IntegrationRun& run, std::optional<Outcome>& last);

/// Jittered grids in independent rounds of doubling size.
Outcome stratified(IntegrationRun& run, std::optional<Outcome>& last);

/// A density, and the integrals as the last round saw them.
struct LearnedDensity {
  std::shared_ptr<const AdaptedDensity> density;
  std::vector<double> control_coefficients = {};
};

/// Learned in rounds of growing size: a 32nd of the calls, or where those are few up to a quarter; up to a fifth where
/// that helps, to two fifths where rare large values may be left to be found. `baseline`, if any, are recorded sequences:
/// learning begins with their points, and gives nothing where they are better than what it learned, as far as both know
/// their error. A density that the caller gave is used as it is where it fits, see DensityLearner::fits; else learning goes on
/// from it. What a round says stands in `last`, unless baseline sequences said something already.
std::optional<LearnedDensity> learn_density(IntegrationRun& run, const ReplicatedSequences* baseline,
                                            std::optional<Outcome>& last);

/// Sequences that double in length: rqmc, vegas, tree, or, for automatic, the best of them.
Outcome replicated_rqmc(IntegrationRun& run, Method method, std::optional<Outcome>& last);

} // namespace mc::detail
