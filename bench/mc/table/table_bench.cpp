// ns per sample with its density, scalar float.
#include <mc/random/pcg.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_2d.h>

#include <benchmark/benchmark.h>

namespace {

std::vector<double> sky(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = 0.5 + mc::hash_uniform<double>(4, i);
  w[n / 3] = 1e5;
  return w;
}

void Pcg32(benchmark::State& state) {
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(random.next32());
}
BENCHMARK(Pcg32);

void Table1D(benchmark::State& state) {
  const mc::TableDist1D<float> table(sky(524288));
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(table.sample_index(random.uniform<float>()));
}
BENCHMARK(Table1D);

void Alias(benchmark::State& state) {
  const mc::AliasTable table(sky(524288));
  mc::Pcg random(1);
  for (auto _ : state) benchmark::DoNotOptimize(table.sample_index(random.uniform<double>()));
}
BENCHMARK(Alias);

void Table2D(benchmark::State& state) {
  const mc::TableDist2D<float> table(sky(524288), 1024, 512);
  mc::Pcg random(1);
  for (auto _ : state) {
    const mc::Vec2<float> x = table.sample(random.point<float, 2>());
    benchmark::DoNotOptimize(table.pdf(x));
  }
}
BENCHMARK(Table2D);

} // namespace
