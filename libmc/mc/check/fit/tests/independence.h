#pragma once
/// Tests that samples in a given order are independent.

#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Tests of the order of samples, such as the rows of a file, which need no density. Each axis has three tests of equal
/// shares:
///   serial pairs : samples 2 i and 2 i + 1 fall independently into 8 x 8 bins of equal numbers of samples; a
///                  chi-square with 49 degrees of freedom, given the counts of rows and columns.
///   correlation  : of the ranks of successive samples, normal.
///   runs         : the number of runs above and below the median, normal.
/// Equal values get ranks in random order. Returns nothing for fewer than 1000 samples.
///   share  : share of alpha of all tests together.
///   Source : [WaldWolfowitz40].
std::vector<Check> test_order(std::span<const Subject::Coordinates> samples, const std::vector<Axis>& axes, int dim,
                              std::uint64_t seed, double share, double alpha);

/// Tests that counts of discrete outcomes do not agree better with their expectations than independent samples do: the
/// lower tail of chi-square. Outcomes that expect fewer than 8 samples are pooled. Returns nothing for fewer than 8
/// pooled outcomes.
std::vector<Check> test_evenness(std::span<const double> counts, std::span<const double> probabilities, double share,
                                 double alpha);

} // namespace mc
