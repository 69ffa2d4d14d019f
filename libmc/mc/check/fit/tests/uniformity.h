#pragma once
/// Whether points are uniform in the unit cube: what inverted samples must be.

#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <array>
#include <optional>
#include <vector>

namespace mc {

/// Fails where the inverse of a sample is not finite, of those that Subject::inverted gives for n draws of the stream
/// `seed`; nothing where all are.
std::optional<Check> check_inverse_finite(const Subject& s, std::uint64_t seed, std::size_t n,
                                          const std::vector<Subject::Coordinates>& inverted);

/// Tests points of [0,1)^dim, dim 1 to 3, as one Check that spends `share` of alpha: along each axis
/// Kolmogorov-Smirnov, mean and mean square, and for each pair of axes their correlation; the smallest p by Sidak over
/// the tests made.
///   error : bound on the error of the coordinates, conceded to them; none when that would leave the tests no power
///   throws : Error when there are no points, or one is not finite
std::optional<Check> test_uniformity(const std::vector<std::array<double, 3>>& points, int dim, double error,
                                     double alpha, double share);

} // namespace mc
