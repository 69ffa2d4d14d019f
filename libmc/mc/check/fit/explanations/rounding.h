#pragma once
/// Failed tests that rounding explains.

#include <mc/check/fit/expected/mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>

namespace mc {

/// A failed test of the mass is inconclusive, of Fault::rounding, if the density itself rounds by as much. Its rounding
/// is the median change between neighbouring points of the pilot.
void explain_mass_by_rounding(const Subject& subject, const Pilot& pilot, const ClaimedMass& mass, Check& test);

} // namespace mc
