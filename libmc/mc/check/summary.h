#pragma once
/// Counts in cells as a report shows them.

#include <mc/check/fit/expected/partition.h>
#include <mc/check/fit/tests/cell_tests.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <vector>

namespace mc {

/// The five cells or outcomes whose counts are farthest from what the density claims, worst first. The first cells lie
/// in `boxes`, the others are outcomes.
///   scale : what a cell's p is multiplied by to give its expected count
std::vector<WorstCell> worst_cells(const Subject& subject, const std::vector<UnitBox>& boxes,
                                   const std::vector<Cell>& cells, double scale);

/// "region theta 0 to 60 deg, phi 0 to 360 deg, about (0, 0, 1), contains 120 samples, 64.0 expected (z = 7.0)": the
/// cell, aligned run of 2, 4, 8, ... cells, or outcome with the largest |z|, given the sum of all counts. Empty if no |z|
/// reaches 4, which chance explains.
std::string describe_worst_region(const Subject& subject, const std::vector<UnitBox>& boxes,
                                  const std::vector<Cell>& cells);

/// All counts, of cells and of outcomes.
void add_counts(const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells, double scale, PlotData& evidence);

/// The subject's axes, named v0, v1, ... where it names none.
std::vector<Axis> named_axes(const Subject& subject);

} // namespace mc
