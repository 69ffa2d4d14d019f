#pragma once
/// Detection of jumps across single axes, which replicates may all miss in the same way.

#include <cstdint>
#include <span>
#include <vector>

namespace mc::detail {

/// Values at the first points of each replicate, with their positions along each axis. A Sobol' sequence has equal
/// shares of points on each side of a jump along an axis, except within one interval of width 1 / points. If no
/// replicate has a point beyond the jump in that interval, all replicates have the same error.
class AxisProfile {
 public:
  static constexpr std::uint64_t most = 128; ///< Maximum number of points of each replicate.

  /// Adds points of the unit cube, with the coordinates of each point in sequence.
  void add_points(std::span<const double> u);
  /// Adds the values of an output at these points.
  void add_values(std::size_t output, std::span<const double> values);
  /// Adds the points of another profile.
  void merge(const AxisProfile& other);
  /// Values of an output at all points.
  const std::vector<double>& values(std::size_t output) const { return values_[output]; }

  /// Largest jump of an output along any axis, or 0. Compares the means of neighbouring bins, 8 to 64 per axis with at
  /// least 24 points each. A step counts as a jump if it exceeds the sum of the steps on both sides by two standard
  /// errors. Slopes, kinks and peaks do not. The points must come from at least two replicates with equal numbers of
  /// points.
  double jump(std::size_t output, std::size_t dim, std::size_t replicates) const;

 private:
  std::vector<std::uint8_t> bins_;          ///< For each point, its bins among 64 along all axes.
  std::vector<std::vector<double>> values_; ///< Values of each output.
};

} // namespace mc::detail
