#pragma once
/// Nested uniform scrambling.

#include <cstdint>

namespace mc {

/// The bits of x in reverse order. Plain arithmetic, so that loops over it vectorise.
constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// The same for 64 bits, or for two words of 32 at once.
constexpr std::uint64_t reverse_bits64(std::uint64_t x) {
  x = __builtin_bswap64(x);
  x = ((x & 0x0f0f0f0f0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0f0f0f0f0fu);
  x = ((x & 0x3333333333333333u) << 2) | ((x >> 2) & 0x3333333333333333u);
  return ((x & 0x5555555555555555u) << 1) | ((x >> 1) & 0x5555555555555555u);
}

/// The hash of Owen's scrambling: a bit of the result depends on its own and lower bits only, so it acts on a reversed
/// word.
constexpr std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Owen's scrambling of the binary fraction x / 2^32: each bit is flipped by a random function of the bits above it, so
/// any elementary interval maps onto one of the same size.
///   Source : [Owen95]; the hash construction by [LaineKarras11], its constants by [Vegdahl21]
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

} // namespace mc
