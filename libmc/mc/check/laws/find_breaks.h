#pragma once
/// Finds jumps and kinks of a map of the unit interval.

#include <mc/check/subject/oracle.h>

#include <functional>
#include <vector>

namespace mc {

/// Returns numbers of (0,1) at which map : [0,1) -> vector of constant length has a jump or a kink. The interval is
/// divided into `segments` steps. The `most` steps that exceed their neighbours most are bisected until two
/// neighbouring numbers of S enclose the jump; the result is the upper number. Changes of slope are treated in the same
/// way, down to the limit of rounding (2^-60 over wide scalars). S is float, double or Oracle. This is a heuristic: it
/// may miss breaks within two segments of another break, and may return steep smooth places.
template <Real S>
std::vector<S> find_breaks(const std::function<std::vector<S>(const S&)>& map, int segments, std::size_t most);

} // namespace mc
