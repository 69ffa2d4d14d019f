#pragma once
/// Nested uniform (Owen) scrambling, and other maps of the bits of an index.

#include <cstdint>

namespace mc {

/// The bits of x in reverse order. Uses only arithmetic that compilers vectorise in loops.
constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// The bits of a 64-bit word in reverse order. Also reverses two packed 32-bit words at once and exchanges them.
constexpr std::uint64_t reverse_bits64(std::uint64_t x) {
  x = __builtin_bswap64(x);
  x = ((x & 0x0f0f0f0f0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0f0f0f0f0fu);
  x = ((x & 0x3333333333333333u) << 2) | ((x >> 2) & 0x3333333333333333u);
  return ((x & 0x5555555555555555u) << 1) | ((x >> 1) & 0x5555555555555555u);
}

/// Owen's scrambling of a bit-reversed word. Each bit of the result depends only on the same and lower bits of x.
constexpr std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Owen's scrambling of the binary fraction x / 2^32. Flips each bit by a random function of the bits above it, so
/// every elementary interval maps to an elementary interval of the same size.
///   Source : [Owen95]. The hash construction is by [LaineKarras11], its constants are by [Vegdahl21].
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

/// Product of the second generator matrix of Sobol's sequence with the bits of an index; the leading bit is last.
/// Column k is row k of Pascal's triangle modulo 2. The triangle modulo 2 is a Kronecker power of [1 1; 0 1], so five
/// shifts apply the whole matrix.
constexpr std::uint32_t pascal_triangle(std::uint32_t i) {
  i ^= (i & 0xaaaaaaaau) >> 1;
  i ^= (i & 0xccccccccu) >> 2;
  i ^= (i & 0xf0f0f0f0u) >> 4;
  i ^= (i & 0xff00ff00u) >> 8;
  return i ^ i >> 16;
}

} // namespace mc
