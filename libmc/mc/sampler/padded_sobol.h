#pragma once
/// Two-dimensional Sobol' points for any number of pairs of dimensions.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

namespace mc {

/// The first two dimensions of Sobol's sequence for each pair of dimensions (0,1), (2,3), ... The seed Owen-scrambles
/// each pair and shuffles its points independently.
///   nets   : Every aligned power-of-two block of indices is a (0,m,2)-net in every pair.
///   error  : RMS error near N^-3/2 for smooth two-dimensional integrands. Different pairs are uncorrelated.
///   Source : [Sobol67], shuffled scrambling [Burley20].
struct PaddedSobol {
  std::uint64_t seed = 0; ///< Seed of the randomisation.

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed, dim / 2);
    const std::uint32_t i = shuffled(index, key);
    const std::uint64_t low = mix64(key ^ (index << 1) ^ dim);
    const std::uint32_t x = reversed(dim % 2 == 0 ? reversed_first(i, key) : reversed_second(i, key));
    return (std::uint64_t{x} << 32) | (low & 0xffffffffu);
  }

  /// Both coordinates of pair `number` of point `index`, with 32 random bits each. The lower bits of a double are zero,
  /// in contrast to bits().
  template <Real S> Vec2<S> pair(std::uint64_t index, std::uint32_t number) const {
    return pair_key(number).template point<S>(index);
  }

  /// The part of the computation that all points of a pair share: pair(index, number) = pair_key(number).point(index).
  struct PairKey {
    std::uint64_t key, ///< Key of the shuffle and of the first coordinate.
        second;        ///< Key of the second coordinate.
    /// Both coordinates of point `index`.
    template <Real S> Vec2<S> point(std::uint64_t index) const {
      const std::uint32_t i = shuffled(index, key);
      // One reversal for both coordinates: it exchanges the halves.
      const std::uint64_t y = owen_scramble_reversed(pascal_triangle(i), static_cast<std::uint32_t>(second));
      const std::uint64_t x = reverse_bits64(y << 32 | reversed_first(i, key));
      return {open_uniform<S>(x & 0xffffffff00000000u), open_uniform<S>(x << 32)};
    }
  };
  /// The key of pair `number`.
  PairKey pair_key(std::uint32_t number) const {
    const std::uint64_t key = hash(seed, number);
    return {key, mix64(key)};
  }

 private:
  static std::uint32_t reversed(std::uint32_t x) { return reverse_bits(x); }
  static std::uint32_t shuffled(std::uint64_t index, std::uint64_t key) {
    return reversed(
        owen_scramble_reversed(reversed(static_cast<std::uint32_t>(index)), static_cast<std::uint32_t>(key)));
  }

  // Scrambled coordinates with the leading bit last, the order in which the index provides the bits and the scrambling
  // hash takes them.
  static std::uint32_t reversed_first(std::uint32_t i, std::uint64_t key) {
    return owen_scramble_reversed(i, static_cast<std::uint32_t>(key >> 32));
  }
  static std::uint32_t reversed_second(std::uint32_t i, std::uint64_t key) {
    return owen_scramble_reversed(pascal_triangle(i), static_cast<std::uint32_t>(mix64(key)));
  }
};

} // namespace mc
