#pragma once
/// Two-dimensional Sobol' points for any number of dimension pairs.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

namespace mc {

/// The first two dimensions of Sobol's sequence, once per pair of dimensions (0,1), (2,3), ..., each pair Owen-scrambled and
/// its points shuffled independently by the seed: every aligned power-of-two block of indices is a (0,m,2)-net in every pair.
///   RMS error of smooth 2-D integrands near N^-3/2; pairs are uncorrelated with each other.
///   Source : [Sobol67], shuffled scrambling [Burley20]
struct PaddedSobol {
  std::uint64_t seed = 0;

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed, dim / 2);
    const std::uint32_t i = owen_scramble(static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(key));
    const std::uint64_t low = mix64(key ^ (index << 1) ^ dim);
    const std::uint32_t x = dim % 2 == 0 ? scrambled_first(i, key) : scrambled_second(i, key);
    return (std::uint64_t{x} << 32) | (low & 0xffffffffu);
  }

  /// Both coordinates of a pair at once.
  template <Real S> Vec2<S> pair(std::uint64_t index, std::uint32_t number) const {
    const std::uint64_t key = hash(seed, number);
    const std::uint32_t i = owen_scramble(static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(key));
    return {uniform<S>(std::uint64_t{scrambled_first(i, key)} << 32), uniform<S>(std::uint64_t{scrambled_second(i, key)} << 32)};
  }

 private:
  static std::uint32_t scrambled_first(std::uint32_t i, std::uint64_t key) {
    return owen_scramble(reverse_bits(i), static_cast<std::uint32_t>(key >> 32));
  }
  static std::uint32_t scrambled_second(std::uint32_t i, std::uint64_t key) {
    return owen_scramble(second(i), static_cast<std::uint32_t>(mix64(key)));
  }

  // Column k of the second generator matrix is row k of Pascal's triangle modulo 2; the product by the whole matrix is five
  // shifts, since the triangle modulo 2 is a Kronecker power of [1 1; 0 1].
  static constexpr std::uint32_t second(std::uint32_t i) {
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    i ^= i >> 16;
    return reverse_bits(i);
  }
};

} // namespace mc
