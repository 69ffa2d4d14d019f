#pragma once
/// A random smooth map of an axis, for each replicate another one.

#include <mc/random/hash.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mc::detail {

/// The map x = u + c u (1 - u) of an axis of the unit cube onto itself, with a random c.
///   why     : A scrambling permutes the elementary intervals of a net and keeps their ends. A jump of the integrand
///             near such an end changes all replicates alike or none of them, so that their spread does not tell its
///             error. The maps move the jump to another place of the net in each replicate.
///   Jacobian: The product w of the slopes. The integral of f is that of f(x) w over u, and f stays as smooth as it is.
///   size    : |c| < 1/8 / sqrt(dim), so that the Jacobians vary little in any dimension. Jumps move by several
///             intervals of a thousand points.
class AxisWarp {
 public:
  /// The map of an axis of a replicate in `dim` dimensions.
  AxisWarp(std::uint64_t seed, std::size_t dim, std::size_t axis) {
    constexpr std::uint64_t apart = 0x77617270; // from the numbers of the scrambling
    const double most = 0.125 / std::sqrt(static_cast<double>(dim));
    c_ = most * (2 * std::ldexp(static_cast<double>(hash(seed, apart, axis) >> 11), -53) - 1);
  }
  /// The map at u. 0 < u < 1 remains so after rounding, since |c| < 1/2.
  double operator()(double u) const { return u + c_ * u * (1 - u); }
  /// The slope of the map at u.
  double slope(double u) const { return 1 + c_ * (1 - 2 * u); }

 private:
  double c_;
};

} // namespace mc::detail
