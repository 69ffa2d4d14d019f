/// RMS relative error of integrate() on Genz's integrals, compared with GSL, shifted Sobol' points and padded
/// Owen-scrambled Sobol' points. Prints a table with the cost of a call.
/// Usage: bench_genz [CALLS [SEEDS [FIRST_SEED [NAME]]]]
/// NAME keeps the integrals that contain it.

#include "gsl_peers.h"

#include <integrands/genz.h>

#include <mc/core/error.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/moments.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/padded_sobol_4d.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using carlo::UnitCubeIntegral;

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

// Sixteen randomisations of the largest power of two of points that fits, padded in groups of four dimensions as in
// OpenQMC.
double padded_sobol(const UnitCubeIntegral& e, std::uint64_t calls, std::uint64_t seed) {
  mc::Moments means;
  const std::uint64_t points = std::bit_floor(calls / 16);
  std::array<double, 8> x{};
  const std::span<const double> point(x.data(), static_cast<std::size_t>(e.dim));
  for (std::uint64_t r = 0; r < 16; ++r) {
    const mc::PaddedSobol4D sampler(mc::hash(seed, r));
    double sum = 0;
    for (std::uint64_t i = 0; i < points; ++i) {
      for (std::uint32_t d = 0; d < point.size(); ++d) x[d] = mc::coordinate<double>(sampler, i, d);
      sum += e.f(point);
    }
    means.add(sum / double(points));
  }
  return means.mean();
}

double by_gsl(const UnitCubeIntegral& e, std::uint64_t calls, int seed, double (bench::Gsl::*method)()) {
  bench::Gsl gsl(e, calls, static_cast<unsigned long>(seed));
  return (gsl.*method)();
}

struct Column {
  double rms = 0, nanoseconds = 0;
};

template <class F> Column measure(const UnitCubeIntegral& e, std::uint64_t calls, int seeds, int first, F&& f) {
  double sum = 0;
  const double start = cpu_seconds();
  for (int s = first; s < first + seeds; ++s) sum += mc::sqr((f(s) - e.truth) / e.truth);
  return {std::sqrt(sum / seeds), (cpu_seconds() - start) / seeds / double(calls) * 1e9};
}

} // namespace

int main(int argc, char** argv) {
  const auto calls = static_cast<std::uint64_t>(argc > 1 ? std::strtod(argv[1], nullptr) : 1e6);
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 20, first = argc > 3 ? std::atoi(argv[3]) : 1;
  const std::string only = argc > 4 ? argv[4] : "";
  std::printf(
      "RMS relative error of %d seeds from %d at %llu calls, one thread; ns: overhead per call beyond the integrand\n",
      seeds, first, static_cast<unsigned long long>(calls));
  std::printf("%-22s %8s %8s %8s %8s %8s %8s | %8s %-5s %6s | %6s %6s\n", "integral", "plain", "miser", "vegas",
              "vegasW", "shifted", "padded", "auto", "", "ratio", "ns", "vegas");
  int won = 0, light = 0, cells = 0;
  for (const UnitCubeIntegral& e : carlo::genz_integrals()) {
    if (e.name.find(only) == std::string::npos) continue;
    ++cells;
    const auto gsl = [&](double (bench::Gsl::*method)()) {
      return measure(e, calls, seeds, first, [&](int s) { return by_gsl(e, calls, s, method); });
    };
    const std::array peers = {
        gsl(&bench::Gsl::plain),
        gsl(&bench::Gsl::miser),
        gsl(&bench::Gsl::vegas),
        gsl(&bench::Gsl::vegas_warm),
        gsl(&bench::Gsl::shifted_sobol),
        measure(e, calls, seeds, first, [&](int s) { return padded_sobol(e, calls, static_cast<std::uint64_t>(s)); })};
    mc::Method picked{};
    const Column ours = measure(e, calls, seeds, first, [&](int s) {
      mc::IntegrateOptions o;
      o.rel_error = 0;
      o.max_calls = calls;
      o.seed = static_cast<std::uint64_t>(s);
      o.threads = 1;
      const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
      mc::require(r.calls <= calls, "integrate made {} calls; {} were allowed", r.calls, calls);
      picked = r.method;
      return r.estimate.value;
    });
    // Time of the integrand alone, on random points, so that its branches are as unpredictable as in an integration.
    const auto dim = static_cast<std::size_t>(e.dim);
    std::vector<double> x(4096 * dim);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = mc::coordinate<double>(mc::Independent{1}, i, 0);
    double sink = 0;
    const double start = cpu_seconds();
    for (int s = 0; s < seeds; ++s)
      for (std::uint64_t i = 0; i < calls; ++i) sink += e.f(std::span(x).subspan(i % 4096 * dim, dim));
    const double alone = (cpu_seconds() - start) / seeds / double(calls) * 1e9 + 0 * sink;
    double best = peers[0].rms;
    std::printf("%-22s", e.name.c_str());
    for (const Column& p : peers) {
      std::printf(" %8.1e", p.rms);
      best = std::min(best, p.rms);
    }
    won += ours.rms <= best;
    light += ours.nanoseconds - alone <= 0.5 * (peers[2].nanoseconds - alone);
    std::printf(" | %8.1e %-5s %6.3f | %6.1f %6.1f\n", ours.rms, std::string(name(picked)).c_str(), ours.rms / best,
                ours.nanoseconds - alone, peers[2].nanoseconds - alone);
    std::fflush(stdout);
  }
  std::printf("auto at or below the best peer in %d of %d, its overhead at most half of gsl_monte_vegas's in %d\n", won,
              cells, light);
}
