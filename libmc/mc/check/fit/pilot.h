#pragma once
/// A pilot sample, independent of the counted samples; it determines the cells.

#include <mc/check/fit/draw_stats.h>

#include <array>
#include <vector>

namespace mc {

/// Returns the change of a coordinate of points near v by rounding: Subject::resolution, or its default.
inline double rounding_step(const Subject& s, const Subject::Coordinates& v, std::size_t axis) {
  return s.resolution ? s.resolution(v, static_cast<int>(axis)) : s.epsilon * v[axis];
}

/// Structures narrower than this number of rounding steps are not tested, because correct distributions round
/// intermediate results too.
inline constexpr double min_resolved_steps = 64;

/// The points of the pilot sample.
struct Pilot {
  std::vector<Subject::Coordinates> points; ///< chart coordinates
  std::vector<double> densities;            ///< claimed density at each point
  PerAxis<std::vector<double>> sorted;      ///< coordinates of the points, sorted on each axis
  DrawStats stats;                          ///< statistics of the pilot's draws

  /// Returns the fraction of the pilot below v on an axis.
  double rank(std::size_t axis, double v) const;
  /// Returns the indices of the `count` points nearest to v on an axis.
  std::vector<std::uint32_t> nearest(std::size_t axis, double v, std::size_t count) const;
};

/// Draws pilot_samples(samples) samples.
Pilot draw_pilot(const Subject& subject, std::uint64_t seed, std::uint64_t samples);

/// Returns an inconclusive Check for each axis that is narrower than two cells, that is 128 steps of rounding. Such
/// coarse samples allow no test of a density along the axis.
std::vector<Check> find_unresolved(const Subject& subject, const Pilot& pilot);

/// Returns the size of the pilot: an eighth of the counted samples, at least 1000 and at most 2^20, which is 256 for
/// each of 4096 cells.
std::uint64_t pilot_samples(std::uint64_t samples);

} // namespace mc
