/// integrate() with `auto`, compared with the best of GSL's vegas and miser, shifted Sobol' points and rqmc, on Genz's
/// integrals and the hard integrals. Prints one CSV row per integral.
/// Usage: bench_mc_estimate_peers [CALLS [SEEDS [FIRST_SEED [NAME]]]]
/// NAME keeps the integrals that contain it.
///   miser ... automatic : RMS relative error over the seeds. vegas is the better of two ways to call it.
///   ratio, ratio_error  : automatic over the best of the others, and its standard error over the seeds.
///   picked              : Shares of the runs that selected vegas and tree.
///   covered, flagged    : Coverage of the 95 % intervals among runs with consistent rounds, and share of runs with
///                         inconsistent rounds.

#include "gsl_peers.h"
#include "hard_integrals.h"

#include <integrands/genz.h>
#include <terminal/version.h>

#include <mc/core/types.h>
#include <mc/estimate/integrate.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

namespace {

using carlo::UnitCubeIntegral;

// Squared relative errors over the seeds.
struct Errors {
  mc::Moments squares;
  void add(double value, double truth) { squares.add(mc::sqr(value / truth - 1)); }
  double rms() const { return std::sqrt(squares.mean()); }
  double relative_error() const { return squares.std_error() / (2 * squares.mean()); }
};

mc::Integral run(const UnitCubeIntegral& e, mc::Method method, std::uint64_t calls, std::uint64_t seed) {
  mc::IntegrateOptions o;
  o.method = method;
  o.rel_error = 0;
  o.max_calls = calls;
  o.seed = seed;
  o.threads = 1;
  return mc::integrate_unit(e.f, e.dim, o);
}

void row(const UnitCubeIntegral& e, std::uint64_t calls, std::uint64_t first, int seeds) {
  Errors miser, vegas, vegas_warm, shifted, rqmc, automatic;
  int grid = 0, tree = 0, covered = 0, agreed = 0;
  for (std::uint64_t s = first; s < first + static_cast<std::uint64_t>(seeds); ++s) {
    const auto gsl = [&](double (bench::Gsl::*method)()) { return (bench::Gsl(e, calls, s).*method)(); };
    miser.add(gsl(&bench::Gsl::miser), e.truth);
    vegas.add(gsl(&bench::Gsl::vegas), e.truth);
    vegas_warm.add(gsl(&bench::Gsl::vegas_warm), e.truth);
    shifted.add(gsl(&bench::Gsl::shifted_sobol), e.truth);
    rqmc.add(run(e, mc::Method::rqmc, calls, s).estimate.value, e.truth);
    const mc::Integral r = run(e, mc::Method::automatic, calls, s);
    automatic.add(r.estimate.value, e.truth);
    grid += name(r.method) == "vegas";
    tree += name(r.method) == "tree";
    agreed += r.consistent;
    covered += r.consistent && r.interval.lo <= e.truth && e.truth <= r.interval.hi;
  }
  const Errors& warm = vegas.rms() < vegas_warm.rms() ? vegas : vegas_warm;
  const std::array<const Errors*, 4> peers = {&miser, &warm, &shifted, &rqmc};
  const Errors& best =
      **std::min_element(peers.begin(), peers.end(), [](auto* a, auto* b) { return a->rms() < b->rms(); });
  const double ratio = automatic.rms() / best.rms();
  fmt::print("{},{},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{:.3f},{:.3f},{:.2f},{:.2f},{:.3f},{:.3f}\n", e.name,
             e.dim, calls, seeds, miser.rms(), warm.rms(), shifted.rms(), rqmc.rms(), automatic.rms(), ratio,
             ratio * std::hypot(automatic.relative_error(), best.relative_error()), double(grid) / seeds,
             double(tree) / seeds, double(covered) / std::max(agreed, 1), 1 - double(agreed) / seeds);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const auto calls = static_cast<std::uint64_t>(argc > 1 ? std::strtod(argv[1], nullptr) : 1e5);
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 20;
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const std::string only = argc > 4 ? argv[4] : "";
  std::string command = "bench_mc_estimate_peers";
  for (int i = 1; i < argc; ++i) command += fmt::format(" {}", argv[i]);
  fmt::print("# command: {}\n# commit: {}\n# seed: {}\n", command, carlo::commit, first);
  fmt::print("integral,dim,calls,seeds,miser,vegas,shifted,rqmc,automatic,ratio,ratio_error,picked_vegas,picked_tree,"
             "covered,flagged\n");
  for (const auto* list : {&carlo::genz_integrals(), &carlo::hard_integrals()})
    for (const UnitCubeIntegral& e : *list)
      if (e.name.find(only) != std::string::npos) row(e, calls, first, seeds);
}
