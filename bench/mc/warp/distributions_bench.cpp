// Random numbers of the normal and the exponential distribution by their inverses, beside the standard library and GSL.
// Their time includes the uniform numbers; those of a warp are precomputed.
#include "../../speed.h"

#include <mc/warp/exponential.h>
#include <mc/warp/normal.h>
#include <mc/warp/sample_n.h>

#ifdef BENCH_GSL
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#endif

#include <random>
#include <string>

namespace {

template <class W> void measure(const std::string& name, double aim, const W& warp) {
  using S = typename W::Scalar;
  static constexpr std::size_t count = 1 << 15;
  const auto numbers = [] {
    std::vector<S> u(count);
    mc::Pcg(1).fill<S>(u);
    return u;
  };
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const std::vector<S> u = numbers();
    for ([[maybe_unused]] const auto _ : state)
      for (const S each : u) {
        const S x = warp.sample(each);
        benchmark::DoNotOptimize(x);
      }
    bench::set_counters(state, count, aim);
  });
  benchmark::RegisterBenchmark((name + "/n").c_str(), [=](benchmark::State& state) {
    const std::vector<S> u = numbers();
    std::vector<S> x(count);
    for ([[maybe_unused]] const auto _ : state) {
      mc::sample_n(warp, {u}, {x});
      benchmark::ClobberMemory();
    }
    bench::set_counters(state, count);
  });
}

template <class Draw> void peer(const std::string& name, Draw draw) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) mutable {
    for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(draw());
    bench::set_counters(state);
  });
}

const bool registered = [] {
  measure("normal, float", 0, mc::Normal<float>());
  measure("normal, double", 10, mc::Normal<double>());
  peer("normal, double: std",
       [engine = std::mt19937_64(1), d = std::normal_distribution<double>()]() mutable { return d(engine); });
  measure("exponential, float", 0, mc::Exponential<float>());
  measure("exponential, double", 7, mc::Exponential<double>());
  peer("exponential, double: std",
       [engine = std::mt19937_64(1), d = std::exponential_distribution<double>()]() mutable { return d(engine); });
#ifdef BENCH_GSL
  gsl_rng* engine = gsl_rng_alloc(gsl_rng_taus2);
  peer("normal, double: GSL ziggurat", [=] { return gsl_ran_gaussian_ziggurat(engine, 1); });
  peer("normal, double: GSL inverse", [=] { return gsl_cdf_ugaussian_Pinv(gsl_rng_uniform_pos(engine)); });
  peer("exponential, double: GSL", [=] { return gsl_ran_exponential(engine, 1); });
#endif
  return true;
}();

} // namespace
