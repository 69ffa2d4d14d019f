// ns per 2-D point, scalar float, random access; and per number in batches.
#include <mc/random/pcg.h>
#include <mc/sampler/halton.h>
#include <mc/sampler/lattice.h>
#include <mc/sampler/multi_jittered.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <benchmark/benchmark.h>

namespace {

void Pcg32(benchmark::State& state) {
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(random.next32());
}
BENCHMARK(Pcg32);

template <class T> void points(benchmark::State& state, const T& sampler) {
  std::uint32_t i = 0;
  for (auto _ : state) {
    const mc::Vec2<float> u = mc::point<float, 2>(sampler, i++ & 0xffff);
    benchmark::DoNotOptimize(u);
  }
}

void PaddedSobolPair(benchmark::State& state) {
  const mc::PaddedSobol sampler{1};
  std::uint32_t i = 0;
  for (auto _ : state) {
    const mc::Vec2<float> u = sampler.pair<float>(i++, 0);
    benchmark::DoNotOptimize(u);
  }
}
BENCHMARK(PaddedSobolPair);
void Sobol(benchmark::State& state) { points(state, mc::Sobol(1)); }
BENCHMARK(Sobol);
void Stratified(benchmark::State& state) { points(state, mc::Stratified(65536, 1)); }
BENCHMARK(Stratified);
void MultiJittered(benchmark::State& state) { points(state, mc::MultiJittered(65536, 1)); }
BENCHMARK(MultiJittered);
void Halton(benchmark::State& state) { points(state, mc::Halton(1)); }
BENCHMARK(Halton);
void Lattice(benchmark::State& state) { points(state, mc::Lattice(1)); }
BENCHMARK(Lattice);

// ns per iteration / 1024 = ns per number.
void SobolScalar1024(benchmark::State& state) {
  const mc::Sobol sampler(1);
  std::vector<float> out(1024);
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < 1024; ++i) out[i] = mc::coordinate<float>(sampler, 1024 + i, 3);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(SobolScalar1024);
void SobolFill1024(benchmark::State& state) {
  const mc::Sobol sampler(1);
  std::vector<float> out(1024);
  for (auto _ : state) {
    sampler.fill<float>(1024, 3, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(SobolFill1024);

} // namespace
