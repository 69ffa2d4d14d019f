#pragma once
/// Detects samples that follow a density rotated about its pole.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/pooled_cells.h>
#include <mc/check/subject/subject.h>

#include <optional>
#include <vector>

namespace mc {

/// Returns the rotation along a periodic chart axis, in (-1/2, 1/2] turns, that makes the claimed density explain the
/// counts; no value if no rotation does. `pilot` is a sample independent of the counts. Small rotations come from the
/// score of the counts, to first order in the angle. Large rotations come from rotating the pilot back.
std::optional<double> find_rotation(const Subject& subject, std::size_t axis, const Partition& partition,
                                    const std::vector<Cell>& cells, const std::vector<Partition::Coordinates>& pilot);

} // namespace mc
