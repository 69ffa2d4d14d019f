#pragma once
/// Four-dimensional Sobol' points for any number of groups of four dimensions.

#include <mc/sampler/sobol.h>

namespace mc {

/// The first four dimensions of Sobol's sequence for each group of dimensions (0..3), (4..7), ... The seed
/// Owen-scrambles each group and shuffles its points independently.
///   nets   : Every aligned block of 2^m indices is a (3,m,4)-net in every group and a (0,m,2)-net in its first two
///            dimensions. Different groups are uncorrelated.
///   use    : For integrands of up to four variables that interact, such as a pixel and a lens. For two interacting
///            variables PaddedSobol is faster, and all its pairs are (0,m,2)-nets.
///   index  : Below 2^32.
///   Source : [Sobol67], direction numbers of [JoeKuo08], shuffled scrambling [Burley20].
class PaddedSobol4D {
 public:
  /// The randomisation that `seed` selects.
  explicit PaddedSobol4D(std::uint64_t seed = 0) : seed_(seed) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed_, dim / 4), own = mix64(key ^ (dim % 4 + 1));
    const std::uint32_t shuffled = owen_scramble(static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(key));
    const std::uint32_t x = owen_scramble(sobol_.unscrambled(shuffled, dim % 4), static_cast<std::uint32_t>(own >> 32));
    return (std::uint64_t{x} << 32) | (mix64(own ^ index) & 0xffffffffu);
  }

 private:
  std::uint64_t seed_;
  Sobol sobol_;
};

} // namespace mc
