#pragma once
/// Jumps across single axes, which replicates may agree on by chance.

#include <cstdint>
#include <span>
#include <vector>

namespace mc::detail {

/// The values at the first points of a replicate, and where these lie on each axis. Sobol' sequences put as many points
/// on both sides of a jump along an axis, but for those in one interval of 1 / points; where none of theirs lies
/// beyond it there, all replicates are off by as much.
class AxisProfile {
 public:
  static constexpr std::uint64_t most = 128; ///< points of each replicate

  /// Points of the unit cube, one after the other.
  void add_points(std::span<const double> u);
  /// The values of an output there.
  void add_values(std::size_t output, std::span<const double> values);
  void merge(const AxisProfile& other);
  const std::vector<double>& values(std::size_t output) const { return values_[output]; }

  /// The largest step between means of neighbouring bins along an axis, 8 to 64 with 24 points or more, of those that
  /// exceed the steps on both sides, as no slope, kink or peak does, by two standard errors of that difference. The
  /// points are those of two replicates or more, as many of each.
  double jump(std::size_t output, std::size_t dim, std::size_t replicates) const;

 private:
  std::vector<std::uint8_t> bins_;          ///< of 64: those of a point together
  std::vector<std::vector<double>> values_; ///< by output
};

} // namespace mc::detail
