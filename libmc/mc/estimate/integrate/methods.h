#pragma once
/// The methods of integrate().

#include <mc/estimate/integrate/correlation.h>
#include <mc/estimate/integrate/run.h>
#include <mc/estimate/integrate/sequences.h>

#include <optional>
#include <vector>

namespace mc::detail {

/// The outcome so far, good for an answer when the run is cancelled.
struct Outcome {
  Means means;
  Method method;
  Stop stop = Stop::max_calls;
  std::vector<Seen> seen = {};                        ///< the values behind the means, one per output
  Correlations correlations = {};                     ///< of the means' errors
  std::shared_ptr<const AdaptedDensity> density = {}; ///< that was learned
};

/// Independent points.
Outcome plain(Run& run, std::optional<Outcome>& last);

/// Jittered grids in independent rounds of doubling size.
Outcome stratified(Run& run, std::optional<Outcome>& last);

/// A density, and the integrals as the last round saw them.
struct Learned {
  std::shared_ptr<const AdaptedDensity> density;
  std::vector<double> centre = {};
};

/// Learned in rounds of growing size: a 32nd of the calls, or where those are few up to a quarter; up to a fifth where
/// that helps, to two fifths where rare large values may be left to be found. `bare`, if any, are recorded sequences:
/// learning begins with their points, and gives nothing where they are better than what it learned, as far as both know
/// their error. A density that the caller gave is used as it is where it fits, see Learner::fits; else learning goes on
/// from it. What a round says stands in `last`, unless bare sequences said something already.
std::optional<Learned> learn(Run& run, const Sequences* bare, std::optional<Outcome>& last);

/// Sequences that double in length: rqmc, vegas, tree, or, for automatic, the best of them.
Outcome sequences(Run& run, Method method, std::optional<Outcome>& last);

} // namespace mc::detail
