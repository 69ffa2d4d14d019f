#pragma once
/// Whether a density was merely turned about its pole.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/tests/cell_tests.h>
#include <mc/check/subject/subject.h>

#include <optional>
#include <vector>

namespace mc {

/// The turn along a periodic chart axis, in (-1/2, 1/2] of the whole, after which the claimed density of the subject
/// explains the counts of its cells, as far as chance lets one say; none when no turn does. `pilot` is a sample
/// independent of the counts. Small turns come from the score of the counts, to first order in the turn; large ones
/// from turning the pilot back.
std::optional<double> find_rotation(const Subject& subject, std::size_t axis, const Partition& partition,
                                    const std::vector<Cell>& cells, const std::vector<Partition::Coordinates>& pilot);

} // namespace mc
