#pragma once
/// Densities with mass within a few rounding steps of an end of the chart.

#include <mc/check/subject/subject.h>

namespace mc {

/// Returns the subject with the density averaged over the last 16 to 32 rounding steps before each end where the
/// density diverges. Samples there are rounded to a lattice of few numbers, and the density at these numbers does not
/// give the mass between them. The average follows from a power law through the densities at the edge of the layer and
/// at 64 times its width. Tests resolve nothing inside the layer, so they need only its mass. The density is not
/// changed where it is not positive and finite at these points, or where the power law does not continue inside the
/// layer. Draws in a layer have at_pole set, and their stated weights are not compared. Draws on the axis of an azimuth
/// get a random azimuth.
Subject average_unresolved_ends(const Subject& subject);

} // namespace mc
