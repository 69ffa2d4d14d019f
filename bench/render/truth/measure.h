#pragma once
/// Estimates the radiance of a picture with any strategy and sampler, and its deviation from the truth.

#include "scenes.h"

#include <render/render.h>

#include <mc/estimate/moments.h>

namespace render::truth {

struct Measured {
  mc::Moments means;              ///< Means of independently randomized point sets.
  bool outlier_dominated = false; ///< See SampleStatistics.
};

/// Estimates the radiance with `sets` sets of `points` points each.
///   in_tile : shares paths with three neighbouring pixels, see PathReuseIntegrator. Their rays deviate by up to 30
///             degrees and differ in every set.
Measured measure(const Picture& picture, const Strategy& strategy, PixelSampler sampler, std::uint64_t seed,
                 std::uint32_t sets, std::uint32_t points, bool in_tile = false);

/// Deviation of `measured` from `should` in standard errors. It is the normal quantile with the same probability as the
/// Student t statistic. `rounding` bounds the rounding to Float and counts as three standard errors. Returns 0 if the
/// estimate is dominated by one sample or no light was found.
double z_score(const Measured& measured, double should, double its_error, double its_dof, double rounding);

} // namespace render::truth
