// Random numbers: pcg32 (the unit of all other benchmarks), uniform numbers from it, and hashed numbers.
#include "../../speed.h"

namespace {

void pcg32(benchmark::State& state) {
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(random.next32());
  bench::set_counters(state, 1, 1.7);
}
BENCHMARK(pcg32);

template <class S> void pcg(benchmark::State& state) {
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(random.uniform<S>());
  bench::set_counters(state);
}
BENCHMARK(pcg<float>)->Name("pcg32 uniform float");
BENCHMARK(pcg<double>)->Name("pcg32 uniform double");

template <class S> void pcg_fill(benchmark::State& state) {
  mc::Pcg random(1);
  std::vector<S> out(1024);
  for ([[maybe_unused]] const auto _ : state) {
    random.fill<S>(out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  bench::set_counters(state, 1024);
}
BENCHMARK(pcg_fill<float>)->Name("pcg32 uniform float/n");
BENCHMARK(pcg_fill<double>)->Name("pcg32 uniform double/n");

void hashed(benchmark::State& state) {
  std::uint64_t i = 0;
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(mc::hash_uniform<float>(1, i++));
  bench::set_counters(state);
}
BENCHMARK(hashed)->Name("hash uniform float");

} // namespace
