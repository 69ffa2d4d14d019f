/// Time of a sample of mc::sample_n in double, as CSV: the yardstick of overhead.py.

#include <mc/random/uniform.h>
#include <mc/warp/disk.h>
#include <mc/warp/half_vector.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/normal.h>
#include <mc/warp/sample_n.h>
#include <mc/warp/sphere.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

constexpr std::size_t samples = 1'000'000;
constexpr int runs = 15;

template <class W> void time_of(const char* name, const W& warp) {
  constexpr std::size_t from = std::tuple_size_v<mc::UnitColumns<W>>, to = std::tuple_size_v<mc::PointColumns<W>>;
  std::vector<double> u(from * samples), x(to * samples);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = mc::hash_uniform<double>(1, i);
  mc::UnitColumns<W> in;
  mc::PointColumns<W> out;
  for (std::size_t k = 0; k < from; ++k) in[k] = std::span(u).subspan(k * samples, samples);
  for (std::size_t k = 0; k < to; ++k) out[k] = std::span(x).subspan(k * samples, samples);
  double best = 1e300;
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    mc::sample_n(warp, in, out);
    best = std::min(best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("\"%s\",%.3f\n", name, best / samples);
}

} // namespace

int main() {
  std::puts("warp,ns");
  time_of("UniformDisk()", mc::UniformDisk<double>());
  time_of("UniformSphere()", mc::UniformSphere<double>());
  time_of("CosineHemisphere()", mc::CosineHemisphere<double>());
  time_of("Normal()", mc::Normal<double>());
  time_of("VonMisesFisher(10)", mc::VonMisesFisher<double>(10));
  time_of("Reflected(TrowbridgeReitzVisibleNormals((0.6, 0, 0.8), 0.3))",
          mc::Reflected(mc::TrowbridgeReitzVisibleNormals<double>({0.6, 0, 0.8}, 0.3)));
  return 0;
}
