#pragma once
/// The radiance of a picture by any strategy and sampler, and how far it is from the truth.

#include "scenes.h"

#include <render/render.h>

#include <mc/estimate/moments.h>

namespace render::truth {

struct Measured {
  mc::Moments means;              ///< of independently randomised point sets
  bool outlier_dominated = false; ///< see SampleSums
};

/// `sets` sets of `points` points each.
///   in_tile : its paths share with those of three pixels beside it, see PathReuseIntegrator, whose rays lead up to 30
///             degrees away, other ones in every set
Measured measure(const Picture& picture, const Strategy& strategy, PixelSampler sampler, std::uint64_t seed,
                 std::uint32_t sets, std::uint32_t points, bool in_tile = false);

/// How many standard errors `measured` is off what it should be: those of a normal variable that is as improbable as
/// Student's t. `rounding` bounds what rounding to Float may do, as three standard errors. 0 where the measured is
/// undecided or no light was found at all.
double z_score(const Measured& measured, double should, double its_error, double its_dof, double rounding);

} // namespace render::truth
