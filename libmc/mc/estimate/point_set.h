#pragma once
/// Points of the unit cube in blocks, for integrators.

#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace mc {

/// A Sobol' sequence of double precision points, Owen-scrambled by the seed.
struct ScrambledSobol {
  std::uint64_t seed = 0;
};

/// Each coordinate interlaces the bits of two of a ScrambledSobol: a net of order 2, whose error for n points of a
/// smooth integrand falls like n^-2.5 but for powers of log n, instead of n^-1.5: measured n^-2.4 in one dimension and
/// below n^-2 in two. In five nothing is gained at 4096 points.
///   Source : [Dick11]
struct InterlacedSobol {
  std::uint64_t seed = 0;
};

/// `count` jittered points, one to each of as many boxes of equal volume, as those of Stratified in groups of 8
/// dimensions, but cheaper: the boxes of the first group come in order, so part of a set is no sample of the cube, and
/// along an axis boxes are cut into the same number of strata throughout. A last group of fewer axes is cut finer.
///   Points keep 2^-50 off the faces of their strata, more than they are rounded by: never 0 or 1.
struct JitteredBoxes {
  std::uint64_t seed = 0;
  std::uint32_t count = 1; ///< at least 1
};

/// The point sets that integrate() places its calls on.
using PointSet = std::variant<Independent, JitteredBoxes, ScrambledSobol, InterlacedSobol>;

/// Writes points first, first + 1, ... to u, the dim coordinates of each side by side; u.size() is a multiple of dim.
///   Independent : the bits of coordinate<double>(sampler, index, dim)
///   JitteredBoxes : indices below its count
///   ScrambledSobol : the leading 32 bits of Sobol(seed), 20 hashed ones and the middle of their interval, so never 0
///            or 1; a whole block at a time, since neighbours in the sequence share all but their low bits. Indices
///            below 2^32
///   InterlacedSobol : so too, with 26 bits each of its coordinates 2 d and 2 d + 1; dim at most 512
void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u);

} // namespace mc
