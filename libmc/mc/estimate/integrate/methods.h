#pragma once
/// The methods of integrate().

#include <mc/estimate/integrate/run.h>

#include <optional>
#include <vector>

namespace mc::detail {

/// The outcome so far, good for an answer when the run is cancelled.
struct Outcome {
  Means means;
  Method method;
  Stop stop = Stop::max_calls;
  std::vector<Magnitudes> seen = {}; ///< the values behind the means, one per output
};

/// Independent points.
Outcome plain(Run& run, std::optional<Outcome>& last);

/// Jittered grids in independent rounds of doubling size.
Outcome stratified(Run& run, std::optional<Outcome>& last);

/// The grid, learned in rounds of growing size on a 32nd of the calls, or, where those are few, on up to a quarter, and
/// the integrals as the last round saw them. Of an integrand whose values are spread widely only a root is learned at
/// first, since few of the largest would speak for all; what is left is less wide.
struct Learned {
  ImportanceGrid grid;
  std::vector<double> centre;
};
Learned learn(Run& run);

/// Sequences that double in length: rqmc, vegas, or, for automatic, the better of the two.
Outcome sequences(Run& run, Method method, std::optional<Outcome>& last);

} // namespace mc::detail
