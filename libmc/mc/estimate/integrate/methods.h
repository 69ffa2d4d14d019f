#pragma once
/// The methods of integrate().

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/integration_run.h>
#include <mc/estimate/integrate/replicated_sequences.h>

#include <optional>
#include <vector>

namespace mc::detail {

/// Result so far. It is the answer of a run that is cancelled.
struct Outcome {
  Means means;                                        ///< Means of the outputs.
  Method method;                                      ///< Method of the means.
  StopReason stop = StopReason::max_calls;            ///< Reason for the end.
  std::vector<IntegrandDiagnostics> diagnostics = {}; ///< Diagnostics of each output.
  Correlations correlations = {};                     ///< Correlations of the errors.
  std::shared_ptr<const AdaptedDensity> density = {}; ///< Learned density, or null.
};

/// Runs Method::plain. Stores intermediate results in `last`.
Outcome plain(IntegrationRun& run, std::optional<Outcome>& last);

/// Runs Method::stratified: jittered points in independent rounds of doubling size. Stores intermediate results in
/// `last`.
Outcome stratified(IntegrationRun& run, std::optional<Outcome>& last);

/// A learned density, with the integrals of the last round as coefficients.
struct LearnedDensity {
  std::shared_ptr<const AdaptedDensity> density; ///< Learned density.
  std::vector<double> control_coefficients = {}; ///< Coefficient of each output.
};

/// Learns a density in rounds of increasing size. Uses a 32nd of the calls, or up to a quarter of a small budget. Uses
/// up to a fifth if that helps, and up to two fifths if rare large values may be missing.
///   baseline : Recorded sequences, or null. Learning starts from their points. Returns nullopt if they are better than
///              the learned density, as far as both errors are known.
///   options.density : Used unchanged if DensityLearner::fits() accepts it; otherwise learning continues from it.
///   last : Receives the result of each round, unless there are baseline sequences.
std::optional<LearnedDensity> learn_density(IntegrationRun& run, const ReplicatedSequences* baseline,
                                            std::optional<Outcome>& last);

/// Runs rqmc, vegas, tree, or for automatic the best of them, with sequences that double in length.
Outcome replicated_rqmc(IntegrationRun& run, Method method, std::optional<Outcome>& last);

} // namespace mc::detail
