#pragma once
/// Axes along which rounding hides the density.

#include <mc/check/fit/pilot.h>
#include <mc/check/report/report.h>

#include <cstddef>
#include <vector>

namespace mc {

/// An axis with its finding, of Fault::rounding.
struct CoarseAxis {
  std::size_t axis;
  Check finding;
};

/// Returns each axis along which the densest quarter of the pilot is narrower than min_resolved_steps rounding steps,
/// if the claimed density has at least half as much mass there. A failed test along such an axis shows the rounding,
/// not a wrong density. Samples that crowd where the density claims less are an atom and not rounded.
std::vector<CoarseAxis> find_coarse_axes(const Subject& subject, const Pilot& pilot);

} // namespace mc
