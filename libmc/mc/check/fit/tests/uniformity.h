#pragma once
/// Tests of uniform points in the unit cube, for inverted samples.

#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <array>
#include <optional>
#include <vector>

namespace mc {

/// Returns a failed Check if the inverse of a sample is not finite; else no value. `inverted` is the result of
/// Subject::inverted for n draws of the stream `seed`.
std::optional<Check> check_inverse_finite(const Subject& s, std::uint64_t seed, std::size_t n,
                                          const std::vector<Subject::Coordinates>& inverted);

/// Tests whether points of [0,1)^dim, dim 1 to 3, are uniform. One Check spends `share` of alpha. It combines
/// Kolmogorov-Smirnov, mean and mean square on each axis with the covariance of each pair of axes, by Sidak's
/// correction of the smallest p.
///   error  : bound on the error of the coordinates, conceded to the points. No Check if this leaves the tests without
///            power.
///   throws : Error if there are no points, or if one is not finite.
std::optional<Check> test_uniformity(const std::vector<Subject::Coordinates>& points, int dim, double error,
                                     double alpha, double share);

} // namespace mc
