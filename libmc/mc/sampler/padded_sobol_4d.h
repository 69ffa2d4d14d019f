#pragma once
/// Four-dimensional Sobol' points for any number of groups of four dimensions.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

#include <array>

namespace mc {

namespace detail {
/// The third and fourth generator matrix of Sobol's sequence: for each of the 8 groups of 4 bits of an index, what the
/// 16 numbers that they can form contribute to both coordinates, the fourth in the upper half. The leading bit of a
/// coordinate is last.
using SobolNibbles = std::array<std::array<std::uint64_t, 16>, 8>;
/// The matrices. Built once per process.
const SobolNibbles& sobol_nibbles();
} // namespace detail

/// The first four dimensions of Sobol's sequence for each group of dimensions (0..3), (4..7), ... The seed
/// Owen-scrambles each group and shuffles its points independently.
///   nets   : Every aligned block of 2^m indices is a (0,m,2)-net in the first two dimensions of every group and a
///            (3,m,4)-net in all four. Different groups are uncorrelated.
///   use    : For integrands of up to four variables that interact, such as a pixel and a lens. For two interacting
///            variables PaddedSobol is faster, and all its pairs are (0,m,2)-nets.
///   index  : Below 2^32.
///   Source : [Sobol67], direction numbers of [JoeKuo08], shuffled scrambling [Burley20].
class PaddedSobol4D {
 public:
  /// The randomisation that `seed` selects.
  explicit PaddedSobol4D(std::uint64_t seed = 0) : seed_(seed), nibbles_(&detail::sobol_nibbles()) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    return Group(*this, index, dim / 4).bits(dim % 4);
  }

  /// Coordinates dim, dim + 1, ... of point `index`: the numbers of coordinate(), with one shuffle for each group.
  template <Real S, int N> Vec<S, N> point(std::uint64_t index, std::uint32_t dim) const {
    Group group(*this, index, dim / 4);
    Vec<S, N> u;
    for (int i = 0; i < N; ++i) {
      const std::uint32_t at = dim + static_cast<std::uint32_t>(i);
      if (i > 0 && at % 4 == 0) group = Group(*this, index, at / 4);
      u[i] = open_uniform<S>(group.bits(at % 4));
    }
    return u;
  }

 private:
  // A point of one group.
  class Group {
   public:
    Group(const PaddedSobol4D& all, std::uint64_t index, std::uint32_t number)
        : index_(index), key_(hash(all.seed_, number)), nibbles_(all.nibbles_),
          shuffled_(owen_scramble(static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(key_))) {}

    std::uint64_t bits(std::uint32_t d) const {
      const std::uint64_t own = mix64(key_ ^ (d + 1));
      // The 64-bit reversal moves the scrambled word to the upper half.
      return reverse_bits64(owen_scramble_reversed(unscrambled(d), static_cast<std::uint32_t>(own >> 32))) |
             (mix64(own ^ index_) & 0xffffffffu);
    }

   private:
    std::uint32_t unscrambled(std::uint32_t d) const {
      if (d == 0) return shuffled_;
      if (d == 1) return pascal_triangle(shuffled_);
      std::uint64_t both = 0;
      for (std::uint32_t k = 0; k < 8; ++k) both ^= (*nibbles_)[k][shuffled_ >> 4 * k & 15];
      return static_cast<std::uint32_t>(d == 2 ? both : both >> 32);
    }

    std::uint64_t index_, key_;
    const detail::SobolNibbles* nibbles_;
    std::uint32_t shuffled_;
  };

  std::uint64_t seed_;
  const detail::SobolNibbles* nibbles_;
};

} // namespace mc
