// Tables with 524288 entries, one of which has a sixth of the weight; scalar float. u comes from pcg32, so that no cell
// stays in the cache by itself.
#include "../../speed.h"

#include <mc/table/alias_table.h>
#include <mc/table/table_dist_2d.h>
#include <mc/table/table_dist_tree.h>

namespace {

std::vector<double> sky(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = 0.5 + mc::hash_uniform<double>(4, i);
  w[n / 3] = 1e5;
  return w;
}

void table_1d(benchmark::State& state) {
  const mc::TableDist1D<float> table(sky(524288));
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(table.sample_index(random.uniform<float>()));
  bench::set_counters(state, 1, 25);
}
BENCHMARK(table_1d)->Name("TableDist1D 524288, index + pmf");

void alias(benchmark::State& state) {
  const mc::AliasTable table(sky(524288));
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(table.sample_index(random.uniform<double>()));
  bench::set_counters(state, 1, 0);
}
BENCHMARK(alias)->Name("AliasTable 524288, index + pmf");

void table_tree(benchmark::State& state) {
  const auto table = mc::TableDistTree<float, 3>::from_function(
      [](const mc::Vec3<double>& x) { return std::exp(-10 * (x.array() - x.mean()).matrix().norm()); }, 1000);
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) {
    const mc::Vec3<float> x = table.sample(random.point<float, 3>());
    benchmark::DoNotOptimize(table.pdf(x));
  }
  bench::set_counters(state, 1, 50);
}
BENCHMARK(table_tree)->Name("TableDistTree 1000 boxes in 3 dimensions, sample + pdf");

void table_2d(benchmark::State& state) {
  const mc::TableDist2D<float> table(sky(524288), 1024, 512);
  mc::Pcg random(1);
  for ([[maybe_unused]] const auto _ : state) {
    const mc::Vec2<float> x = table.sample(random.point<float, 2>());
    benchmark::DoNotOptimize(table.pdf(x));
  }
  bench::set_counters(state, 1, 50);
}
BENCHMARK(table_2d)->Name("TableDist2D 1024x512, sample + pdf");

} // namespace
