#pragma once
/// Integer hashes: random numbers as a pure function of a key.

#include <cstdint>

namespace mc {

/// Bijective 64-bit mix with full avalanche. Source: [Stafford11], variant 13, the finaliser of splitmix64.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Hash of a key of any length, such as hash(seed, pixel, sample, dim). The order of the parts matters.
template <class... Parts> constexpr std::uint64_t hash(std::uint64_t first, Parts... rest) {
  std::uint64_t h = mix64(first + 0x9e3779b97f4a7c15ULL);
  ((h = mix64((h ^ static_cast<std::uint64_t>(rest)) + 0x9e3779b97f4a7c15ULL)), ...);
  return h;
}

} // namespace mc
