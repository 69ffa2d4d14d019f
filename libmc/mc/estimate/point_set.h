#pragma once
/// Point sets of integrate(), generated in blocks.

#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>

#include <cstdint>
#include <span>
#include <variant>

namespace mc {

/// Owen-scrambled Sobol' sequence with coordinates of double precision.
struct ScrambledSobol {
  std::uint64_t seed = 0; ///< Seed of the scrambling.
  bool warped = false;    ///< Whether each axis has a detail::AxisWarp.
};

/// Each coordinate interlaces the bits of two coordinates of a ScrambledSobol. The result is a net of order 2. For
/// smooth integrands, the RMS error is O(n^-2.5) up to powers of log n, instead of O(n^-1.5). The gain vanishes in
/// higher dimensions at practical n; see docs/methods/point-sets.md.
///   Source : [Dick11].
struct InterlacedSobol {
  std::uint64_t seed = 0; ///< Seed of the scrambling.
  bool warped = false;    ///< Whether each axis has a detail::AxisWarp.
};

/// `count` jittered points, one in each of `count` boxes of equal volume, in groups of 8 dimensions. Like Stratified,
/// but faster.
///   order    : The boxes of the first group are in order, so a part of a set is no sample of the cube.
///   strata   : Along an axis, all boxes are cut into the same number of strata. A last group with fewer axes is cut
///              finer.
///   rounding : Points stay 2^-50 away from the faces of their strata, more than the rounding error. They are never 0
///              or 1.
struct JitteredBoxes {
  std::uint64_t seed = 0;  ///< Seed of the jitter.
  std::uint32_t count = 1; ///< Number of points, at least 1.
};

/// A point set of integrate().
using PointSet = std::variant<Independent, JitteredBoxes, ScrambledSobol, InterlacedSobol>;

/// Whether the axes of a set have maps, so that its points have Jacobians.
bool is_warped(const PointSet& set);

/// Writes points first, first + 1, ... to u, with the dim coordinates of each point in sequence. u.size() must be a
/// multiple of dim. Writes their Jacobians to `jacobians`, whose size must be the number of points; it may be empty for
/// sets without maps. A warped set has the images of these points:
///   Independent     : The bits of coordinate<double>(sampler, index, dim).
///   JitteredBoxes   : Indices must be below its count.
///   ScrambledSobol  : The leading 32 bits of Sobol(seed), then 20 hashed bits, at the middle of the interval of that
///                     precision. Never 0 or 1. Indices must be below 2^32.
///   InterlacedSobol : Same, with 26 bits from each of the coordinates 2 d and 2 d + 1. dim must be at most 512.
void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u,
                 std::span<double> jacobians = {});

} // namespace mc
