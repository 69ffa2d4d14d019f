#pragma once
/// Recognises rounding to float, or to coarser steps, as the cause of a failed test.

#include <mc/check/subject/any_distribution.h>

#include <string>

namespace mc {

/// Returns a clause for the report that names a coordinate with coarse steps and suggests a remedy. The clause is empty
/// if no coordinate has them. The function inspects 1000 samples for:
///   pole        : cos theta near the pole in steps of 2^-24, which are wide compared with a narrow lobe; over float
///                 and double.
///   coordinates : coordinates, radii and angles that are floats although the distribution claims double. Also
///                 multiples of a power of two coarser than the spacing of floats at the largest value. Over float,
///                 only these coarser steps count.
std::string describe_quantization(const AnyDistribution& distribution, std::uint64_t seed);

/// Returns ", off by the rounding error of float: ..." for a point just outside the domain of a distribution over
/// double. The point must be at most four float epsilons outside. One of its coordinates must be a float with more than
/// half of its digits in use, which a double rarely is. Returns an empty string for other points.
std::string describe_float_rounding(const AnyDistribution& distribution, const PointArray& x);

} // namespace mc
