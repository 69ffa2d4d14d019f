// ns per number: pcg32, the yardstick of all other benchmarks, and hashed numbers.
#include <mc/random/pcg.h>

#include <benchmark/benchmark.h>

namespace {

void Pcg32(benchmark::State& state) {
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(random.next32());
}
BENCHMARK(Pcg32);

void PcgUniformFloat(benchmark::State& state) {
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(random.uniform<float>());
}
BENCHMARK(PcgUniformFloat);

void HashUniformFloat(benchmark::State& state) {
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(mc::hash_uniform<float>(1, i++));
}
BENCHMARK(HashUniformFloat);

} // namespace
