#pragma once
/// Halton's sequence.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

#include <cstddef>

namespace mc {

/// Randomisation of the digits of a Halton point.
enum class HaltonScramble {
  /// For each digit position a random affine map of the digit, equal for all points. Keeps the regularity of the
  /// sequence.
  digits,
  /// A random affine map of the index. Decouples neighbouring bases. The pairs of points have the joint distribution of
  /// Owen's nested scrambling, on which alone the variance depends.
  owen
};

namespace detail {

/// What the digits of a dimension take, for indices below base^digits, the largest power that is at most 2^32. Digits
/// are taken in groups: base^group_digits numbers, whose reversals stand in a table.
struct HaltonBase {
  std::uint32_t base;
  std::uint32_t group;           ///< base^group_digits.
  std::uint32_t rest;            ///< base^(digits of the last group).
  std::uint32_t groups;          ///< Number of groups but the last.
  std::uint64_t period,          ///< base^digits.
      units;                     ///< period / base.
  std::uint64_t group_inverse,   ///< Floor of 2^64 / group.
      rest_inverse,              ///< Floor of 2^64 / rest.
      width;                     ///< Floor of 2^64 / period.
  const std::uint16_t *reversed, ///< Reversals of all digits of a group; null for one digit.
      *reversed_rest;            ///< The same of the last group.
};

/// The bases of Halton::dimensions dimensions. Dimension 0 is not used.
const HaltonBase* halton_bases();

inline std::uint64_t high_product(std::uint64_t a, std::uint64_t b) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>((Wide{a} * b) >> 64);
}

// Divides i by n, of which `inverse` is the floor of 2^64 / n. Returns the remainder.
inline std::uint64_t divide(std::uint64_t& i, std::uint64_t n, std::uint64_t inverse) {
  const std::uint64_t quotient = high_product(i, inverse), rest = i - quotient * n;
  const bool is_short = rest >= n;
  i = quotient + is_short;
  return is_short ? rest - n : rest;
}

} // namespace detail

/// Randomised Halton points. Coordinate `dim` is the radical inverse of the index in the dim-th prime base b.
/// Dimensions from Halton::dimensions on are independent hashed numbers.
///   strata : Among any b^k consecutive indices aligned to b^k, each interval [j, j + 1) b^-k contains one point, for
///            b^k up to 2^32.
///   cost   : Prefer Sobol for counts that are powers of two.
///   index  : Indices that differ by a multiple of the largest b^k up to 2^32 share an interval of the length b^-k,
///            with independent places in it (owen) or the same (digits).
///   Source : [Halton60]; pairs of points and the variance [Owen95], [Matousek98]. The affine map a i + c of the index
///            modulo b^m has the same pairs: if two indices differ first in digit k, then a times their difference is
///            b^k times a uniform number without the factor b, and c makes each image uniform.
class Halton {
 public:
  /// Number of dimensions of the construction.
  static constexpr std::uint32_t dimensions = 1024;

  /// The randomisation that `seed` selects.
  explicit Halton(std::uint64_t seed = 0, HaltonScramble scramble = HaltonScramble::owen)
      : seed_(seed), scramble_(scramble), bases_(detail::halton_bases()) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed_, dim);
    if (dim >= dimensions) return mix64(key ^ index);
    const bool nested = scramble_ == HaltonScramble::owen;
    const auto rest = static_cast<std::uint32_t>(index);
    // The place in the last interval: equal for all points if digit-scrambled.
    const std::uint64_t place = mix64(~key + (nested ? index * 0x9e3779b97f4a7c15ULL : 0));
    if (dim == 0) {
      const std::uint32_t x = nested ? owen_scramble(reverse_bits(rest), static_cast<std::uint32_t>(key >> 32))
                                     : reverse_bits(rest) ^ static_cast<std::uint32_t>(key >> 32);
      return (std::uint64_t{x} << 32) | (place >> 32);
    }
    const detail::HaltonBase& b = bases_[dim];
    return in_interval(nested ? radical_inverse(affine(rest, b, key), b) : with_scrambled_digits(rest, b, key), b,
                       place);
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
  static std::uint32_t base(std::uint32_t dim) { return detail::halton_bases()[dim].base; }

 private:
  // a index + c, below 2^64, with a below the period and not divisible by the base, and c below the period.
  static std::uint64_t affine(std::uint32_t index, const detail::HaltonBase& b, std::uint64_t key) {
    const std::uint64_t high = detail::high_product(key, b.units),
                        low = 1 + detail::high_product(key * b.units, b.base - 1);
    return (high * b.base + low) * index + detail::high_product(mix64(key), b.period);
  }

  // The reversed digits of i, of which it takes as many as the period has.
  static std::uint64_t radical_inverse(std::uint64_t i, const detail::HaltonBase& b) {
    std::uint64_t value = 0;
    for (std::uint32_t k = 0; k < b.groups; ++k) {
      const std::uint64_t digits = detail::divide(i, b.group, b.group_inverse);
      value = value * b.group + (b.reversed ? b.reversed[digits] : digits);
    }
    const std::uint64_t digits = detail::divide(i, b.rest, b.rest_inverse);
    return value * b.rest + (b.reversed_rest ? b.reversed_rest[digits] : digits);
  }

  static std::uint64_t with_scrambled_digits(std::uint32_t rest, const detail::HaltonBase& b, std::uint64_t key) {
    std::uint64_t value = 0;
    for (std::uint64_t position = 1, scale = 1; scale < b.period; ++position, scale *= b.base) {
      const std::uint64_t h = mix64(key + position * 0x9e3779b97f4a7c15ULL);
      const std::uint64_t a = 1 + (((h & 0xffffffffu) * (b.base - 1)) >> 32), c = ((h >> 32) * b.base) >> 32;
      value = value * b.base + (a * (rest % b.base) + c) % b.base;
      rest /= b.base;
    }
    return value;
  }

  // A point strictly inside of interval `value` of `period` equal ones, as a 64-bit fraction.
  static std::uint64_t in_interval(std::uint64_t value, const detail::HaltonBase& b, std::uint64_t place) {
    const std::uint64_t over = 0 - b.width * b.period; // of 2^64 = width period + over
    return value * b.width + detail::high_product(value * over, b.width) + 1 + detail::high_product(place, b.width - 1);
  }

  std::uint64_t seed_;
  HaltonScramble scramble_;
  const detail::HaltonBase* bases_;
};

} // namespace mc
