#pragma once
/// Nested uniform scrambling.

#include <cstdint>

namespace mc {

/// The bits of x in reverse order.
constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// Owen's scrambling of the binary fraction x / 2^32: each bit is flipped by a random function of the bits above it, so any
/// elementary interval maps onto one of the same size. A hash in which a bit depends on lower bits only, applied to the
/// reversed word.
///   Source : [Owen95]; the hash construction by [LaineKarras11], its constants by [Vegdahl21]
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

} // namespace mc
