#pragma once
/// Halton's sequence.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

#include <array>
#include <cstddef>

namespace mc {

/// Randomisation of the digits of a Halton point. The permutations are random affine maps d -> a d + c modulo the prime
/// base. They map any two digits to any two others with equal probability, on which alone the variance depends
/// [Matousek98].
enum class HaltonScramble {
  /// One permutation per digit position, equal for all points. Keeps the regularity of the sequence.
  digits,
  /// One permutation per digit position and value of the digits before it (nested). Decouples neighbouring bases.
  owen
};

/// Randomised Halton points. Coordinate `dim` is the radical inverse of the index in the dim-th prime base. Dimensions
/// from Halton::dimensions on are independent hashed numbers.
///   strata : Among any b^k consecutive indices aligned to b^k, each interval [j, j + 1) b^-k of the dimension with
///            base b contains one point.
///   cost   : Grows with the number of digits of 2^32 in the base. Prefer Sobol for counts that are powers of two.
///   index  : From 2^32 on, digit-scrambled points repeat, and nested points differ only below the digits of 2^32.
///   Source : [Halton60].
class Halton {
 public:
  /// Number of dimensions of the construction.
  static constexpr std::uint32_t dimensions = 1024;

  /// The randomisation that `seed` selects.
  explicit Halton(std::uint64_t seed = 0, HaltonScramble scramble = HaltonScramble::owen)
      : seed_(seed), scramble_(scramble) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed_, dim);
    if (dim >= dimensions) return mix64(key ^ index);
    const bool nested = scramble_ == HaltonScramble::owen;
    const auto rest = static_cast<std::uint32_t>(index);
    // Digits below the digits of a 32-bit index: equal for all points if digit-scrambled, independent for each point if
    // nested.
    const std::uint64_t tail = nested ? hash(~key, index) : hash(~key);
    if (dim == 0) {
      const std::uint32_t x = nested ? owen_scramble(reverse_bits(rest), static_cast<std::uint32_t>(key >> 32))
                                     : reverse_bits(rest) ^ static_cast<std::uint32_t>(key >> 32);
      return (std::uint64_t{x} << 32) | (tail >> 32);
    }
    return scrambled(rest, base(dim), key, nested, tail);
  }

  /// Coordinate `dim` of point `index` before scrambling, dim < dimensions: a quotient of whole numbers, rounded once.
  static double radical_inverse(std::uint32_t index, std::uint32_t dim) {
    std::uint64_t value = 0, scale = 1;
    for (; index > 0; index /= base(dim)) {
      value = value * base(dim) + index % base(dim);
      scale *= base(dim);
    }
    return static_cast<double>(value) / static_cast<double>(scale);
  }
  /// Prime base of dimension `dim`, dim < dimensions.
  static constexpr std::uint32_t base(std::uint32_t dim) { return primes[dim]; }

 private:
  static constexpr std::uint64_t scrambled(std::uint32_t rest, std::uint32_t b, std::uint64_t key, bool nested,
                                           std::uint64_t tail) {
    std::uint64_t value = 0, scale = 1;
    for (std::uint64_t position = 1; scale < std::uint64_t{1} << 32; ++position) {
      const std::uint64_t h = mix64(key + position * 0x9e3779b97f4a7c15ULL + (nested ? mix64(value) : 0));
      const std::uint64_t a = 1 + (((h & 0xffffffffu) * (b - 1)) >> 32), c = ((h >> 32) * b) >> 32;
      value = value * b + (a * (rest % b) + c) % b;
      rest /= b;
      scale *= b;
    }
    return jittered(value, scale, tail);
  }

  static constexpr std::array<std::uint16_t, dimensions> primes = [] {
    std::array<std::uint16_t, dimensions> found{};
    std::array<bool, 8192> composite{};
    std::size_t n = 0;
    for (std::size_t i = 2; n < dimensions; ++i) {
      if (composite[i]) continue;
      found[n++] = static_cast<std::uint16_t>(i);
      for (std::size_t j = i * i; j < composite.size(); j += i) composite[j] = true;
    }
    return found;
  }();

  std::uint64_t seed_;
  HaltonScramble scramble_;
};

} // namespace mc
