#pragma once
/// A first sample, independent of the one that is counted: it says where the cells go.

#include <mc/check/fit/draw_stats.h>

#include <array>
#include <vector>

namespace mc {

/// How far rounding moves a coordinate of points near v: Subject::resolution, or what it says of subjects without one.
inline double rounding_step(const Subject& s, const Subject::Coordinates& v, std::size_t axis) {
  return s.resolution ? s.resolution(v, static_cast<int>(axis)) : s.epsilon * v[axis];
}

/// What is narrower than so many steps of rounding is not tested: a sampler rounds on the way, too.
inline constexpr double min_resolved_steps = 64;

struct Pilot {
  std::vector<Subject::Coordinates> points;
  std::vector<double> densities;             ///< claimed at the points
  std::array<std::vector<double>, 3> sorted; ///< the coordinates of the points, by axis
  DrawStats stats;

  /// The share of the pilot below v on an axis.
  double rank(std::size_t axis, double v) const;
  /// The indices of the `count` points that are nearest to v on an axis.
  std::vector<std::uint32_t> nearest(std::size_t axis, double v, std::size_t count) const;
};

/// pilot_samples(samples) draws.
Pilot draw_pilot(const Subject& subject, std::uint64_t seed, std::uint64_t samples);

/// A Check, inconclusive, for each axis that is all narrower than two cells can be, 128 steps of rounding: samples that
/// are rounded so tell nothing of a density along it.
std::vector<Check> find_unresolved(const Subject& subject, const Pilot& pilot);

/// Samples that make the cells: an eighth of those that are counted, at least 1000, at most 2^20, which is 256 for each
/// of 4096 cells.
std::uint64_t pilot_samples(std::uint64_t samples);

} // namespace mc
