#pragma once
// Counters and points for the benchmarks in the table of speed_table.cpp.

#include <mc/random/pcg.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace bench {

/// Sets the number of items per iteration and the target time per item. The target is in ns on a machine on which one
/// draw of pcg32 takes 1.7 ns; 0: no target.
inline void set_counters(benchmark::State& state, double items = 1, double aim = 0) {
  state.counters["items"] = items;
  state.counters["aim"] = aim;
}

/// Precomputed points of [0,1)^2: few enough for the cache, too many for the branch predictor to memorize.
template <class S> std::vector<mc::Vec2<S>> random_points(std::size_t n = 1 << 15) {
  mc::Pcg random(1);
  std::vector<mc::Vec2<S>> u(n);
  for (auto& v : u) v = random.point<S, 2>();
  return u;
}

} // namespace bench
