#pragma once
/// Independent uniform points.

#include <mc/sampler/concept.h>

namespace mc {

/// Independent uniform numbers: a 64-bit hash of (seed, index, dim). The RMS error of a mean of N values is O(N^-1/2).
struct Independent {
  std::uint64_t seed = 0; ///< Seed; each gives independent points.

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const { return hash(seed, index, dim); }
};

} // namespace mc
