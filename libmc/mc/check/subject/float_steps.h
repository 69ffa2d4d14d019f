#pragma once
/// Rounding to float as the cause of what the tests found.

#include <mc/check/subject/any_sampler.h>

#include <string>

namespace mc {

/// What comes in steps of a float although the sampler says otherwise, and what to do about it: one clause for a
/// report, empty where nothing does. Looked at are 1000 samples:
///   cos theta near the pole, whose steps of 2^-24 are wide beside a narrow lobe, over float and over double
///   coordinates, radii and angles of a sampler over double
std::string float_steps(const AnySampler& sampler, std::uint64_t seed);

} // namespace mc
