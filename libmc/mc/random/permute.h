#pragma once
/// Random access to random permutations.

#include <mc/random/hash.h>

#include <bit>
#include <cstdint>

namespace mc {

/// Pseudo-random permutation of [0, n), n >= 1, selected by `seed`. A bijective mix of the smallest power of two >= n
/// is repeated until the result lies below n, which takes at most 2 steps on average.
///   uniformity : The images of any two positions are uniform over seeds, by a chi-square test in the unit tests.
///   Source     : Cycle walking [BlackRogaway02]. The mix is xor-shift and odd multiplication, each bijective modulo
///                2^k.
class Permutation {
 public:
  /// The permutation of [0, n) that `seed` selects, n >= 1.
  Permutation(std::uint32_t n, std::uint64_t seed) : n_(n), seed_(seed), bits_(std::bit_width(n - 1)) {}

  /// Image of i, for i < n.
  std::uint32_t operator()(std::uint32_t i) const {
    if (n_ <= 1) return 0;
    do
      for (std::uint64_t r = 0; r < rounds(); ++r) i = round(i, key(r));
    while (i >= n_);
    return i;
  }

  /// One step of the mix, for callers that process many positions at once: i = round(i, key(r)) for each r < rounds(),
  /// repeated while i >= n.
  std::uint64_t rounds() const { return bits_ <= 4 ? 6 : 4; } // few bits mix slowly: 4 rounds leave a bias for n <= 16
  /// Key of round r.
  std::uint64_t key(std::uint64_t r) const { return mix64(seed_ + r * 0x9e3779b97f4a7c15ULL); }
  /// Applies one round with the given key to i.
  std::uint32_t round(std::uint32_t i, std::uint64_t key) const {
    const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits_) - 1);
    const int shift = bits_ > 2 ? bits_ / 2 : 1;
    i = (i ^ static_cast<std::uint32_t>(key)) & mask;
    i = (i * (static_cast<std::uint32_t>(key >> 32) | 1u)) & mask;
    i ^= i >> shift;
    i = (i * (static_cast<std::uint32_t>(key >> 48) | 1u) + static_cast<std::uint32_t>(key >> 16)) & mask;
    return i ^ i >> shift;
  }
  /// Number n of permuted elements.
  std::uint32_t size() const { return n_; }

 private:
  std::uint32_t n_;
  std::uint64_t seed_;
  int bits_;
};

/// Image of `i` under the permutation of [0, n) that `seed` selects.
inline std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t seed) { return Permutation(n, seed)(i); }

} // namespace mc
