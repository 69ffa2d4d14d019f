/// Calibration of the error bars of integrate() on Genz's integrals. Prints a table for each method: shares of runs
/// within 1 and 2 standard errors of the exact value, and within the 95 % interval.
/// Usage: bench_mc_estimate_calibration [RUNS [CALLS [FIRST_SEED [METHOD [NAME]]]]]
/// RUNS is per integral. NAME keeps the integrals that contain it. Runs with inconsistent rounds (`consistent` is
/// false) are counted separately, and the shares exclude them.

#include <integrands/genz.h>

#include <mc/estimate/integrate.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace {

struct Shares {
  int runs = 0, flagged = 0, within1 = 0, within2 = 0, covered = 0;
  double squares = 0, log_error = 0;

  void add(const mc::Integral& r, double truth) {
    ++runs;
    if (!r.consistent) {
      ++flagged;
      return;
    }
    const double distance = std::abs(r.estimate.value - truth);
    within1 += distance <= r.estimate.std_error;
    within2 += distance <= 2 * r.estimate.std_error;
    covered += r.interval.lo <= truth && truth <= r.interval.hi;
    squares += distance * distance;
    log_error += std::log(r.estimate.std_error);
  }
  void merge(const Shares& s) {
    runs += s.runs;
    flagged += s.flagged;
    within1 += s.within1;
    within2 += s.within2;
    covered += s.covered;
  }
  void print(const std::string& name, std::string_view method, double scale) const {
    const double n = runs - flagged;
    fmt::print("{:<11} {:<22} {:>6} {:>7.4f} {:>7.4f} {:>7.4f} {:>8.4f}", method, name, runs, within1 / n, within2 / n,
               covered / n, double(flagged) / runs);
    if (scale > 0)
      fmt::print(" {:>8.3f} {:>9.2e}", std::exp(log_error / n) / std::sqrt(squares / n),
                 std::sqrt(squares / n) / scale);
    fmt::print("\n");
  }
};

} // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 1000;
  const auto calls = static_cast<std::uint64_t>(argc > 2 ? std::strtod(argv[2], nullptr) : 1e4);
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const std::string only = argc > 4 ? argv[4] : "", integrals = argc > 5 ? argv[5] : "";
  fmt::print("{} runs of {} calls per integral from seed {}; error/rms: geometric mean of the standard error over the "
             "actual error\n",
             runs, calls, first);
  fmt::print("{:<11} {:<22} {:>6} {:>7} {:>7} {:>7} {:>8} {:>8} {:>9}\n", "method", "integral", "runs", "1 sigma",
             "2 sigma", "95 %", "flagged", "err/rms", "rel. rms");
  for (const mc::Method method : {mc::Method::plain, mc::Method::stratified, mc::Method::rqmc, mc::Method::vegas,
                                  mc::Method::tree, mc::Method::automatic}) {
    if (!only.empty() && only != name(method)) continue;
    Shares all;
    std::uint64_t seed = first; // differs between integrals: integrals of equal dimension would share their points
    for (const carlo::UnitCubeIntegral& e : carlo::genz_integrals()) {
      if (e.name.find(integrals) == std::string::npos) continue;
      Shares shares;
      for (int i = 0; i < runs; ++i) {
        mc::IntegrateOptions o;
        o.method = method;
        o.rel_error = 0;
        o.max_calls = calls;
        o.seed = seed++;
        o.threads = 1;
        shares.add(mc::integrate_unit(e.f, e.dim, o), e.truth);
      }
      shares.print(e.name, name(method), std::abs(e.truth));
      all.merge(shares);
    }
    all.print("all", name(method), 0);
    std::fflush(stdout);
  }
}
