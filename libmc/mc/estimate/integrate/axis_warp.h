#pragma once
/// A random smooth map of the axes, for each replicate another one.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mc::detail {

/// Maps each axis of the unit cube onto itself by x = u + c u (1 - u), with a random c.
///   why     : A scrambling permutes the elementary intervals of a net and keeps their ends. A jump of the integrand
///             near such an end changes all replicates alike or none of them, so that their spread does not tell its
///             error. The maps move the jump to another place of the net in each replicate.
///   density : An integral is the mean of f(x) times the Jacobian, the product of 1 + c (1 - 2 u). f stays as smooth as
///             it is.
///   size    : |c| < strength / sqrt(dim), so that the Jacobians vary little in any dimension. Jumps move by several
///             intervals of a thousand points.
class AxisWarp {
 public:
  static constexpr double strength = 0.125; ///< Largest c in one dimension.

  /// The map of a replicate.
  AxisWarp(std::uint64_t seed, std::size_t dim);
  /// Maps points strictly inside the cube to such points, and writes their Jacobians.
  void apply(std::span<double> points, std::span<double> jacobians) const;

 private:
  std::vector<double> c_;
};

} // namespace mc::detail
