// Overhead of a parallel loop: tasks of some 50 us each, with all threads. Wall-clock time.
#include <mc/core/parallel.h>

#include <benchmark/benchmark.h>

namespace {

void work() {
  volatile double x = 0;
  for (int i = 0; i < 20'000; ++i) x = x + i;
}

void alone(benchmark::State& state) {
  for ([[maybe_unused]] const auto _ : state)
    for (int i = 0; i < state.range(0); ++i) work();
}
BENCHMARK(alone)->Arg(2)->Arg(4)->Arg(16)->UseRealTime();

void in_parallel(benchmark::State& state) {
  for ([[maybe_unused]] const auto _ : state)
    mc::parallel_for(static_cast<std::size_t>(state.range(0)), 0, [](std::size_t) { work(); });
}
BENCHMARK(in_parallel)->Arg(2)->Arg(4)->Arg(16)->UseRealTime();

} // namespace
