// Points by random access, and sequences of points in one dimension; scalar float.
#include "../../speed.h"

#include <mc/sampler/halton.h>
#include <mc/sampler/lattice.h>
#include <mc/sampler/multi_jittered.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/padded_sobol_4d.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#ifdef BENCH_OPENQMC
#include <oqmc/sobol.h>
#endif

namespace {

// The first 65536 points in scattered order, as pixels and paths access them.
template <class F> void points(benchmark::State& state, double aim, const F& point) {
  std::uint32_t i = 0;
  for ([[maybe_unused]] const auto _ : state) {
    const mc::Vec2<float> u = point((i += 40503) & 0xffff);
    benchmark::DoNotOptimize(u);
  }
  bench::set_counters(state, 1, aim);
}
template <class T> auto pair_of(const T& sampler) {
  return [sampler](std::uint32_t i) { return mc::point<float, 2>(sampler, i, 2); };
}

void padded(benchmark::State& state) {
  points(state, 12, [sampler = mc::PaddedSobol{1}](std::uint32_t i) { return sampler.pair<float>(i, 1); });
}
BENCHMARK(padded)->Name("Sobol 2-D, padded, Owen");
void sobol(benchmark::State& state) { points(state, 12, pair_of(mc::Sobol(1))); }
BENCHMARK(sobol)->Name("Sobol dims 2 and 3, Owen");
void stratified(benchmark::State& state) { points(state, 0, pair_of(mc::Stratified(65536, 1))); }
BENCHMARK(stratified)->Name("stratified 2-D");
void multi_jittered(benchmark::State& state) { points(state, 0, pair_of(mc::MultiJittered(65536, 1))); }
BENCHMARK(multi_jittered)->Name("multi-jittered 2-D");
void halton(benchmark::State& state) { points(state, 0, pair_of(mc::Halton(1))); }
BENCHMARK(halton)->Name("Halton dims 2 and 3, Owen");
template <class S> void padded_4d(benchmark::State& state) {
  std::uint32_t i = 0;
  const mc::PaddedSobol4D sampler(1);
  for ([[maybe_unused]] const auto _ : state)
    benchmark::DoNotOptimize(mc::point<S, 4>(sampler, (i += 40503) & 0xffff, 4));
  bench::set_counters(state, 4, 6);
}
BENCHMARK(padded_4d<float>)->Name("Sobol 4-D, padded, a number, float");
BENCHMARK(padded_4d<double>)->Name("Sobol 4-D, padded, a number, double");
#ifdef BENCH_OPENQMC
void padded_4d_of_openqmc(benchmark::State& state) {
  std::uint32_t i = 0;
  for ([[maybe_unused]] const auto _ : state) {
    float u[4];
    oqmc::SobolSampler(0, 0, 0, static_cast<int>((i += 40503) & 0xffff), nullptr).newDomain(1).drawSample<4>(u);
    benchmark::DoNotOptimize(u);
  }
  bench::set_counters(state, 4, 6);
}
BENCHMARK(padded_4d_of_openqmc)->Name("Sobol 4-D, padded, a number, float: OpenQMC");
#endif
void halton_numbers(benchmark::State& state) {
  std::uint32_t i = 0;
  const mc::Halton sampler(1);
  for ([[maybe_unused]] const auto _ : state) {
    ++i;
    for (std::uint32_t d = 0; d < 10; ++d) benchmark::DoNotOptimize(mc::coordinate<float>(sampler, i, d));
  }
  bench::set_counters(state, 10, 10);
}
BENCHMARK(halton_numbers)->Name("Halton dims 0 to 9, a number");
void lattice(benchmark::State& state) { points(state, 0, pair_of(mc::Lattice(1))); }
BENCHMARK(lattice)->Name("lattice 2-D");

constexpr std::uint64_t run = 1024;

template <class S> void run_scalar(benchmark::State& state) {
  const mc::Sobol sampler(1);
  std::vector<S> out(run);
  for ([[maybe_unused]] const auto _ : state) {
    for (std::uint64_t i = 0; i < run; ++i) out[i] = mc::coordinate<S>(sampler, run + i, 3);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  bench::set_counters(state, run);
}
BENCHMARK(run_scalar<float>)->Name("Sobol run in dim 3, float");
BENCHMARK(run_scalar<double>)->Name("Sobol run in dim 3, double");

template <class S> void run_filled(benchmark::State& state) {
  const mc::Sobol sampler(1);
  std::vector<S> out(run);
  for ([[maybe_unused]] const auto _ : state) {
    sampler.fill<S>(run, 3, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  bench::set_counters(state, run);
}
BENCHMARK(run_filled<float>)->Name("Sobol run in dim 3, float/n");
BENCHMARK(run_filled<double>)->Name("Sobol run in dim 3, double/n");

} // namespace
