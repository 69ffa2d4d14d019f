#pragma once
/// Two-dimensional Sobol' points for any number of dimension pairs.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

namespace mc {

/// The first two dimensions of Sobol's sequence, once per pair of dimensions (0,1), (2,3), ..., each pair
/// Owen-scrambled and its points shuffled independently by the seed: every aligned power-of-two block of indices is a
/// (0,m,2)-net in every pair.
///   RMS error of smooth 2-D integrands near N^-3/2; pairs are uncorrelated with each other.
///   Source : [Sobol67], shuffled scrambling [Burley20]
struct PaddedSobol {
  std::uint64_t seed = 0;

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed, dim / 2);
    const std::uint32_t i = shuffled(index, key);
    const std::uint64_t low = mix64(key ^ (index << 1) ^ dim);
    const std::uint32_t x = reversed(dim % 2 == 0 ? reversed_first(i, key) : reversed_second(i, key));
    return (std::uint64_t{x} << 32) | (low & 0xffffffffu);
  }

  /// Both coordinates of a pair at once, of 32 bits: a double has zeros where those of bits() go on.
  template <Real S> Vec2<S> pair(std::uint64_t index, std::uint32_t number) const {
    return pair_key(number).template point<S>(index);
  }

  /// What all points of a pair share, for callers that take many: pair(index, number) = pair_key(number).point(index).
  struct PairKey {
    std::uint64_t key, second;
    template <Real S> Vec2<S> point(std::uint64_t index) const {
      const std::uint32_t i = shuffled(index, key);
      // One reversal for both: the lower half becomes the upper one.
      const std::uint64_t y = owen_scramble_reversed(pascal(i), static_cast<std::uint32_t>(second));
      const std::uint64_t x = reverse_bits64(y << 32 | reversed_first(i, key));
      return {uniform<S>(x & 0xffffffff00000000u), uniform<S>(x << 32)};
    }
  };
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

  // Scrambled coordinates, with the leading bit last: the order in which the index gives them and the hash wants them.
  static std::uint32_t reversed_first(std::uint32_t i, std::uint64_t key) {
    return owen_scramble_reversed(i, static_cast<std::uint32_t>(key >> 32));
  }
  static std::uint32_t reversed_second(std::uint32_t i, std::uint64_t key) {
    return owen_scramble_reversed(pascal(i), static_cast<std::uint32_t>(mix64(key)));
  }

  // Column k of the second generator matrix is row k of Pascal's triangle modulo 2; the product by the whole matrix is
  // five shifts, since the triangle modulo 2 is a Kronecker power of [1 1; 0 1].
  static constexpr std::uint32_t pascal(std::uint32_t i) {
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    return i ^ i >> 16;
  }
};

} // namespace mc
