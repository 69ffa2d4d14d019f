// Runs the checker on every known bug: rejections at alpha = 1 % over several seeds, next to the rejection rates of the
// checkers of other renderers.
// Usage: bench_mc_check_power [SEEDS [SAMPLES [ID]]]. The default is 20 seeds of 1e6 samples.

#include <known_bugs/known_bugs.h>

#include <mc/core/parallel.h>

#include <fmt/format.h>

#include <cstdlib>
#include <map>

namespace {

// Rejection rates of other checkers, measured at alpha = 1 % and 1e6 samples. Columns: Nori's chi-square, its warptest
// (5.2e6 samples), Mitsuba 3, pbrt-v4. `best` is the best of a multi-resolution chi-square, KS, moments and mass.
struct Peers {
  double nori, warptest, mitsuba, pbrt, best;
};
const std::map<std::string, Peers> peers = {
    {"C1", {1, 1, .05, 0, 1}},  {"C2", {0, 0, 0, 0, 1}},    {"C3", {.05, 0, 0, 0, .05}}, {"C4", {.95, 1, .85, .25, 1}},
    {"C5", {1, 1, 1, 1, 1}},    {"C6", {0, 0, .95, 0, 0}},  {"C7", {1, 0, 1, 0, 1}},     {"C8", {1, 1, 1, .1, 1}},
    {"C9", {0, 0, 0, 0, 1}},    {"C10", {1, 1, .1, .1, 1}}, {"C11", {0, 0, 0, 0, 0}},    {"C12", {.8, 1, 1, 1, 1}},
    {"C13", {.2, 0, 0, 0, .9}}, {"C14", {1, 1, 1, .8, 1}},  {"C15", {0, 1, 1, 0, 1}},    {"C16", {0, .5, 0, 0, .1}},
    {"V1", {1, 1, .2, 0, 1}},   {"V2", {1, 0, 1, 0, 1}},    {"V3", {1, 1, 1, 1, 1}},     {"V4", {1, 0, 1, 0, 1}},
    {"V5", {.5, 1, 0, 0, 1}},   {"V6", {0, 0, 0, 0, .5}},   {"V7", {1, 1, .4, 0, 1}},    {"V8", {1, 1, 1, 1, 1}},
    {"V9", {1, 1, .4, .1, 1}},  {"V10", {1, 1, .3, 0, 1}},
};

} // namespace

int main(int argc, char** argv) {
  const auto seeds = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const auto samples = static_cast<std::uint64_t>(argc > 2 ? std::atof(argv[2]) : 1e6);
  const std::string only = argc > 3 ? argv[3] : "";
  fmt::print("{:<46} {:>5} {:>9} {:>9}  {:<28} | {:>5} {:>8} {:>8} {:>5} {:>5}\n", "mutant, alpha = 1 %", "runs",
             "rejected", "s per run", "by", "nori", "warptest", "mitsuba", "pbrt", "best");
  for (const carlo::KnownBug& bug : carlo::all_known_bugs()) {
    if (!only.empty() && only != bug.id) continue;
    std::vector<mc::Report> reports(seeds);
    mc::parallel_for(seeds, 0, [&](std::size_t i) {
      reports[i] = bug.wrong.check({.samples = samples, .seed = i + 1, .alpha = 0.01});
    });
    std::size_t rejected = 0;
    double seconds = 0;
    std::string by;
    for (const mc::Report& r : reports) {
      rejected += r.verdict() == mc::Verdict::fail;
      seconds += r.seconds;
      for (const mc::Check& c : r.checks)
        if (by.empty() && c.verdict == mc::Verdict::fail) by = c.name;
    }
    fmt::print("{:<46} {:>5} {:>9} {:>9.3f}  {:<28}", bug.title(), seeds, rejected,
               seconds / static_cast<double>(seeds), by);
    if (const auto p = peers.find(bug.id); p != peers.end())
      fmt::print(" | {:>5.2f} {:>8.2f} {:>8.2f} {:>5.2f} {:>5.2f}", p->second.nori, p->second.warptest,
                 p->second.mitsuba, p->second.pbrt, p->second.best);
    fmt::print("\n");
    std::fflush(stdout);
  }
}
