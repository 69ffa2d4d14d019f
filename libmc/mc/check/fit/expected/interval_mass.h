#pragma once
/// Integrals of the claimed density over a layer of the unit cube, with an error estimate that uses nearby samples.

#include <mc/check/fit/expected/estimated_mass.h>
#include <mc/check/fit/pilot.h>
#include <mc/check/subject/subject.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mc {

/// The layer of the cube between two values of one coordinate, with the samples near it.
struct IntervalQuery {
  std::size_t axis = 0;
  double lo = 0, hi = 1;
  /// Indices of pilot points inside; if these are few, also of points next to the layer.
  std::vector<std::uint32_t> near;
  double mass = 0; ///< mass of the layer according to the samples
  /// Whether no sample lies in the layer; an integral that is too small then only favours the samples.
  bool empty = false;
};

/// Returns the layer and a point of the domain at its centre, for example "theta in [1.5, 3] deg, for example about
/// (0.04, 0, 0.999),". The point helps because some axes are not coordinates of the domain.
std::string describe_interval(const Subject& subject, std::size_t axis, double lo, double hi);

/// Amount of work; quick uses at most a sixteenth of the points.
enum class Effort : std::uint8_t { quick, full };

/// Estimates the integral over a layer with two random pairs of points in each of many boxes. The layer is cut between
/// its near points. The cuts stop when each box contains at most four near points and no density there claims far more
/// mass for the box than the samples do. A lobe or ridge of any sharpness thus gets small boxes. If the density at a
/// near point far exceeds the density at all random points of its box, the variance includes the mass that the random
/// points missed. Empty layers omit this term, since the integral can only be too small.
///   Source : stratified sampling, with two mirrored pairs each [Cochran77].
EstimatedMass interval_mass(const Subject& subject, const Pilot& pilot, const IntervalQuery& query, std::uint64_t seed,
                            Effort effort = Effort::full);

} // namespace mc
