#pragma once
/// Sequential random streams from pcg-cpp.

#include <mc/random/uniform.h>

#include <pcg_random.hpp>

namespace mc {

/// A stream of independent random bits: pcg32 (XSH-RR, period 2^64 per stream, 2^63 streams) [ONeill14].
///   Same (seed, stream), same bits, on every machine. Prefer hash_uniform where random access by key is wanted.
class Pcg {
 public:
  explicit Pcg(std::uint64_t seed = 0, std::uint64_t stream = 0) : engine_(mix64(seed + 1), stream) {}

  std::uint32_t next32() { return engine_(); }
  std::uint64_t next64() { return (std::uint64_t{engine_()} << 32) | engine_(); }

  /// Uniform in [0,1): one 32-bit draw for float, two for wider scalars.
  template <Real S> S uniform() {
    if constexpr (std::same_as<S, float>) return mc::uniform<S>(std::uint64_t{engine_()} << 32);
    else return mc::uniform<S>(next64());
  }

  /// A point of [0,1)^N; a plain scalar when N = 1.
  template <Real S, int N> Point<S, N> point() {
    if constexpr (N == 1) return uniform<S>();
    else {
      Point<S, N> u;
      for (int i = 0; i < N; ++i) u[i] = uniform<S>();
      return u;
    }
  }

  /// Skips n 32-bit draws in O(log n).
  void advance(std::uint64_t n) { engine_.advance(n); }

 private:
  pcg32 engine_;
};

} // namespace mc
