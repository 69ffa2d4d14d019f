/// CPU seconds of integrate() to a given error, beside GSL and Sobol' points. Prints CSV: one row for each integral,
/// program and error. Every program gets budgets of 8e3, 3.2e4 ... 2.048e6 calls; time and RMS error over the seeds are
/// interpolated between them, both on logarithmic axes.
/// Usage: bench_mc_estimate_seconds [SEEDS [NAME [PROGRAM]]]
/// NAME and PROGRAM keep the integrals and programs that contain them.
///   ms_to_1e-3, ms_to_1e-4 : user CPU of one thread [ms]; "inf" if no budget reaches the error.
///   ns_per_call            : at the largest budget.
///   wanted_*               : ours with the wanted error given instead of a budget, at most 1e7 calls: user CPU [ms],
///                            RMS relative error, and mean calls.

#include "gsl_peers.h"
#include "seconds_integrals.h"

#include <terminal/version.h>

#include <mc/core/types.h>
#include <mc/estimate/integrate.h>

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <string>

namespace {

using carlo::UnitCubeIntegral;

struct Answer {
  double value;
  std::uint64_t calls;
};
using Program =
    std::function<Answer(const UnitCubeIntegral&, std::uint64_t calls, double rel_error, unsigned long seed)>;

Program ours(mc::Method method) {
  return [method](const UnitCubeIntegral& e, std::uint64_t calls, double rel_error, unsigned long seed) -> Answer {
    mc::IntegrateOptions o;
    o.method = method;
    o.rel_error = rel_error;
    o.max_calls = calls;
    o.seed = seed;
    o.threads = 1;
    const mc::Integral r = mc::integrate_unit(e.f, e.dim, o);
    return {r.estimate.value, r.calls};
  };
}

Program gsl(double (bench::Gsl::*method)()) {
  return [method](const UnitCubeIntegral& e, std::uint64_t calls, double, unsigned long seed) -> Answer {
    return {(bench::Gsl(e, calls, seed).*method)(), calls};
  };
}

// Sobol's sequence from its second point on: the first is a corner.
Answer unscrambled_sobol(const UnitCubeIntegral& e, std::uint64_t calls, double, unsigned long) {
  const mc::Sobol sobol;
  const auto dim = static_cast<std::uint32_t>(e.dim);
  std::vector<double> x(dim);
  double sum = 0;
  for (std::uint32_t i = 1; i <= calls; ++i) {
    for (std::uint32_t d = 0; d < dim; ++d) x[d] = 0x1p-32 * sobol.unscrambled(i, d);
    sum += e.f(x);
  }
  return {sum / double(calls), calls};
}

// CPU [ms] of one run and RMS relative error, over the seeds. Short runs are repeated.
struct Cost {
  double ms = 0, rms = 0, calls = 0;
};
Cost cost(const Program& run, const UnitCubeIntegral& e, std::uint64_t calls, double rel_error, int seeds) {
  Cost c;
  int runs = 0;
  const std::clock_t begin = std::clock();
  do {
    for (int s = 1; s <= seeds; ++s) {
      const Answer a = run(e, calls, rel_error, static_cast<unsigned long>(s));
      if (runs < seeds) {
        c.rms += mc::sqr(a.value / e.truth - 1) / seeds;
        c.calls += double(a.calls) / seeds;
      }
      ++runs;
    }
  } while (double(std::clock() - begin) / CLOCKS_PER_SEC < 0.02);
  c.ms = 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC / runs;
  c.rms = std::sqrt(c.rms);
  return c;
}

// Time to an error, by interpolation: the cheapest way to reach it. A budget that reaches it by itself is an upper
// bound.
double ms_to(double error, const std::vector<Cost>& costs) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (costs[i].rms > error) continue;
    best = std::min(best, costs[i].ms);
    if (i == 0 || costs[i - 1].rms <= error || costs[i].rms == 0) continue;
    const double share = std::log(costs[i - 1].rms / error) / std::log(costs[i - 1].rms / costs[i].rms);
    best = std::min(best, costs[i - 1].ms * std::pow(costs[i].ms / costs[i - 1].ms, share));
  }
  return best;
}

void row(const UnitCubeIntegral& e, std::string_view name, const Program& run, bool is_ours, int seeds) {
  std::vector<Cost> costs;
  for (std::uint64_t calls = 8000; calls <= 2'048'000; calls *= 4) costs.push_back(cost(run, e, calls, 0, seeds));
  fmt::print("{},{},{},{:.3g},{:.3g},{:.3g},{:.3g}", e.name, e.dim, name, ms_to(1e-3, costs), ms_to(1e-4, costs),
             1e6 * costs.back().ms / costs.back().calls, costs.back().rms);
  for (const double error : {1e-3, 1e-4}) {
    if (!is_ours) {
      fmt::print(",,,");
      continue;
    }
    const Cost c = cost(run, e, 10'000'000, error, seeds);
    fmt::print(",{:.3g},{:.2g},{:.0f}", c.ms, c.rms, c.calls);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 6;
  const std::string only = argc > 2 ? argv[2] : "", program = argc > 3 ? argv[3] : "";
  struct Named {
    std::string_view name;
    Program run;
    bool ours;
  };
  const std::array<Named, 10> programs = {{{"auto", ours(mc::Method::automatic), true},
                                           {"rqmc", ours(mc::Method::rqmc), true},
                                           {"vegas", ours(mc::Method::vegas), true},
                                           {"tree", ours(mc::Method::tree), true},
                                           {"gsl_plain", gsl(&bench::Gsl::plain), false},
                                           {"gsl_miser", gsl(&bench::Gsl::miser), false},
                                           {"gsl_vegas", gsl(&bench::Gsl::vegas), false},
                                           {"gsl_vegas_warm", gsl(&bench::Gsl::vegas_warm), false},
                                           {"sobol_shifted", gsl(&bench::Gsl::shifted_sobol), false},
                                           {"sobol_unscrambled", unscrambled_sobol, false}}};
  std::string command = "bench_mc_estimate_seconds";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);
  fmt::print("# command: {}\n# commit: {}\n# seed: 1\n", command, carlo::commit);
  fmt::print("integral,dim,program,ms_to_1e-3,ms_to_1e-4,ns_per_call,last_rms,wanted_1e-3_ms,wanted_1e-3_rms,"
             "wanted_1e-3_calls,wanted_1e-4_ms,wanted_1e-4_rms,wanted_1e-4_calls\n");
  for (const UnitCubeIntegral& e : bench::seconds_integrals()) {
    if (e.name.find(only) == std::string::npos) continue;
    for (const Named& p : programs)
      if (p.name.find(program) != std::string_view::npos) row(e, p.name, p.run, p.ours, seeds);
  }
}
