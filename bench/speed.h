#pragma once
// What a benchmark tells the table of speed_table.cpp.

#include <mc/random/pcg.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace bench {

/// Items per iteration, and the time per item that is aimed at, in ns, on a machine where one draw of pcg32 takes 1.7
/// ns; 0 if none is.
inline void set_counters(benchmark::State& state, double items = 1, double aim = 0) {
  state.counters["items"] = items;
  state.counters["aim"] = aim;
}

/// Points of [0,1)^2 made beforehand: few enough for the cache, too many for the branch predictor to learn by heart.
template <class S> std::vector<mc::Vec2<S>> random_points(std::size_t n = 1 << 15) {
  mc::Pcg random(1);
  std::vector<mc::Vec2<S>> u(n);
  for (auto& v : u) v = random.point<S, 2>();
  return u;
}

} // namespace bench
