#pragma once
/// Sequential random streams from pcg-cpp.

#include <mc/random/uniform.h>

#include <pcg_random.hpp>

#include <array>
#include <span>

namespace mc {

/// Stream of independent random bits: pcg32 (XSH-RR, period 2^64 per stream, 2^63 streams) [ONeill14].
///   Equal (seed, stream) give equal bits on every machine. Use hash_uniform() for random access by key.
///   Stream numbers from 2^32 on are hashed, because increments that differ only in their upper bits give similar
///   streams.
class Pcg {
 public:
  /// Starts stream `stream` at the state that `seed` selects.
  explicit Pcg(std::uint64_t seed = 0, std::uint64_t stream = 0)
      : engine_(mix64(seed + 1), stream < (std::uint64_t{1} << 32) ? stream : mix64(stream)) {}

  /// The next 32 random bits.
  std::uint32_t next32() { return engine_(); }
  /// The next 64 random bits, from two 32-bit draws.
  std::uint64_t next64() {
    const std::uint64_t high = engine_();
    return high << 32 | engine_();
  }

  /// Uniform number in [0,1). Takes one 32-bit draw for float and two for wider scalars.
  template <Real S> S uniform() {
    if constexpr (std::same_as<S, float>) return mc::uniform<S>(std::uint64_t{engine_()} << 32);
    else return mc::uniform<S>(next64());
  }

  /// Uniform point of [0,1)^N; a plain scalar if N = 1.
  template <Real S, int N> Point<S, N> point() {
    if constexpr (N == 1) return uniform<S>();
    else {
      Point<S, N> u;
      for (int i = 0; i < N; ++i) u[i] = uniform<S>();
      return u;
    }
  }

  /// Fills `out` with the numbers that repeated calls of uniform<S>() would return. Faster, because leapfrogging copies
  /// of the stream run in parallel lanes.
  template <std::floating_point S> void fill(std::span<S> out) {
    std::size_t done = 0;
    if (out.size() >= 2 * lanes) done = engine_.fill(out);
    for (S& u : out.subspan(done)) u = uniform<S>();
  }

  /// Skips n 32-bit draws in O(log n).
  void advance(std::uint64_t n) { engine_.advance(n); }

  /// Whether both generators have the same state and stream, and so return the same numbers from now on.
  friend bool operator==(const Pcg& a, const Pcg& b) { return a.engine_ == b.engine_; }

 private:
  static constexpr std::size_t lanes = 32;

  struct Engine : pcg32 {
    Engine(std::uint64_t seed, std::uint64_t stream) : pcg32(seed, stream) {}

    // Fills whole rows of `lanes` numbers and returns the number of values written.
    template <class S> std::size_t fill(std::span<S> out) {
      constexpr std::size_t draws = std::same_as<S, float> ? 1 : 2;
      const std::uint64_t factor = multiplier(), step = increment();
      // A skip of `lanes` numbers is again an affine map of the state. Its values at 0 and 1 determine it.
      const std::uint64_t row_step = pcg32::advance(0, lanes * draws, factor, step);
      const std::uint64_t row_factor = pcg32::advance(1, lanes * draws, factor, step) - row_step;
      std::array<std::uint64_t, lanes> state;
      for (std::size_t k = 0; k < lanes; ++k) {
        state[k] = state_;
        pcg32::advance(draws);
      }
      std::size_t done = 0;
      for (; done + lanes <= out.size(); done += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) {
          std::uint64_t bits = std::uint64_t{pcg32::output(state[k])} << 32;
          if constexpr (draws == 2) bits |= pcg32::output(state[k] * factor + step);
          out[done + k] = mc::uniform<S>(bits);
          state[k] = state[k] * row_factor + row_step;
        }
      }
      state_ = state[0];
      return done;
    }
  };
  Engine engine_;
};

} // namespace mc
