#pragma once
/// The integral of the claimed density over a layer of the unit cube, and how far samples say that it may be off.

#include <mc/check/fit/expected/estimated_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/subject/subject.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mc {

/// All of the cube between two values of one coordinate, and what samples say of it.
struct IntervalQuery {
  std::size_t axis = 0;
  double lo = 0, hi = 1;
  std::vector<std::uint32_t> near; ///< points of the pilot: those inside; where they are few, also some beside it
  double mass = 0;                 ///< inside, were the samples right
  bool empty = false;              ///< of samples: what an integral misses there speaks for them, not against
};

/// "theta in [1.5, 3] deg, for example about (0.04, 0, 0.999),": a layer and a point of the domain in the middle of it,
/// since some axes are no coordinates of the domain.
std::string describe_interval(const Subject& subject, std::size_t axis, double lo, double hi);

/// quick : from a sixteenth of the points or less
enum class Effort : std::uint8_t { quick, full };

/// From two random pairs of points in each of many boxes. The layer is cut where its near points are, until no box
/// holds more than four, nor one whose density claims far more for the box than the samples do: a lobe or a ridge of
/// any sharpness is looked at where it is. A near point whose density is far above all that the random points of its
/// box saw tells what each of them would have added, had it not missed the place; the variance allows for that,
/// but in empty layers, where the integral is only ever too small.
///   Source : stratified sampling, with two mirrored pairs each [Cochran77]
EstimatedMass interval_mass(const Subject& subject, const Pilot& pilot, const IntervalQuery& query, std::uint64_t seed,
                            Effort effort = Effort::full);

} // namespace mc
