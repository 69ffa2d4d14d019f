#pragma once
/// Rounding to float, or to coarser steps, as the cause of what the tests found.

#include <mc/check/subject/any_distribution.h>

#include <string>

namespace mc {

/// What comes in steps of a float although the sampler says otherwise, and what to do about it; or in steps of a power
/// of two that are coarser than those of its largest float: one clause for a report, empty where nothing does. Looked
/// at are 1000 samples:
///   cos theta near the pole, whose steps of 2^-24 are wide beside a narrow lobe, over float and over double
///   coordinates, radii and angles; those of a sampler over float for coarser steps alone
std::string describe_quantization(const AnyDistribution& distribution, std::uint64_t seed);

/// What to do about a point outside the domain of a sampler over double, ", as far off as float rounds: ...": where it
/// is at most four epsilons of a float off and one of its numbers is a float with more than half of its digits in use,
/// as hardly a double is. Empty for any other point.
std::string describe_float_rounding(const AnyDistribution& distribution, const PointArray& x);

} // namespace mc
