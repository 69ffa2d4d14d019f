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

/// Learns the grid in rounds of growing size, on a 32nd of the calls, or, where those are few, on up to a quarter.
///   scale : 1 for each output at first; becomes what makes outputs of different size count alike
ImportanceGrid learn(Run& run, std::vector<double>& scale);

/// Sequences that double in length: rqmc, vegas, or, for automatic, the better of the two.
Outcome sequences(Run& run, Method method, std::optional<Outcome>& last);

} // namespace mc::detail
