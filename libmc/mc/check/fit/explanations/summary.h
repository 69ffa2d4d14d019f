#pragma once
/// Summaries of the counts in cells, for reports.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/pooled_cells.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <vector>

namespace mc {

/// Returns the five cells or outcomes with the largest |observed - expected| / sqrt(expected), worst first. The first
/// boxes.size() cells lie in `boxes`; the others are outcomes.
///   scale : factor from a cell's p to its expected count.
std::vector<WorstCell> worst_cells(const Subject& subject, const std::vector<UnitBox>& boxes,
                                   const std::vector<Cell>& cells, double scale);

/// Describes the cell, aligned run of 2, 4, 8, ... cells, or outcome with the largest |z|, given the sum of all counts.
/// Returns for example "region theta 0 to 60 deg, phi 0 to 360 deg, about (0, 0, 1), contains 120 samples, 64.0
/// expected (z = 7.0)". Returns an empty string if all |z| < 4, which chance explains.
std::string describe_worst_region(const Subject& subject, const std::vector<UnitBox>& boxes,
                                  const std::vector<Cell>& cells);

/// Appends the counts of all cells and outcomes to `evidence`.
void add_counts(const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells, double scale, PlotData& evidence);

/// Returns the subject's axes; axes without a name are called v0, v1, ...
std::vector<Axis> named_axes(const Subject& subject);

} // namespace mc
