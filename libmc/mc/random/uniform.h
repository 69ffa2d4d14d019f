#pragma once
/// Conversion of random bits to uniform numbers in [0,1).

#include <mc/core/types.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <concepts>
#include <cstdint>

namespace mc {

/// Converts the leading bits of a 64-bit word to a multiple of 2^-p in [0, 1 - 2^-p], with p = 24 for float and 53 for
/// double. The conversion is exact, so the result is never 1. A multiprecision scalar gets the double.
template <Real S> S uniform(std::uint64_t bits) {
  if constexpr (std::same_as<S, float>) return static_cast<float>(bits >> 40) * 0x1p-24f;
  else return S(static_cast<double>(bits >> 11) * 0x1p-53);
}

/// The same number, but half a step, 2^-(p+1), instead of 0: it lies in (0,1).
template <Real S> S open_uniform(std::uint64_t bits) {
  return std::max(uniform<S>(bits), S(std::same_as<S, float> ? 0x1p-25 : 0x1p-54));
}

/// Uniform number in [0,1) as a pure function of a key, such as hash_uniform<float>(seed, pixel, sample, dim).
template <Real S, class... Parts> S hash_uniform(std::uint64_t first, Parts... rest) {
  return uniform<S>(hash(first, rest...));
}

} // namespace mc
