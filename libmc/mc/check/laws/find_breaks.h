#pragma once
/// Where a map of the unit interval jumps or bends: beside its branches.

#include <mc/check/subject/oracle.h>

#include <functional>
#include <vector>

namespace mc {

/// Numbers of (0,1) at which map : [0,1) -> a vector of always the same length has a jump or a kink. The interval is
/// scanned in `segments` steps; the `most` steps that stand out from their neighbours are halved until two neighbouring
/// numbers of S enclose the jump, of which the upper one is returned; likewise for changes of slope, as far down as
/// rounding lets them be seen (2^-60 over wide scalars). S is float, double or Oracle.
/// A heuristic: breaks closer than two segments to another may be missed, and steep smooth places may be returned.
template <Real S>
std::vector<S> find_breaks(const std::function<std::vector<S>(const S&)>& map, int segments, std::size_t most);

} // namespace mc
