#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>
#include <mc/stats/binomial.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

constexpr double margin_of_region = 1.04; // a region may be rotated, or longer than wide

// A run of cells with a large deviation. A count with a variance s times smaller than its expectation is compared as s
// * count with s * expectation, which keeps the skewness of small counts; s = 1 for plain counts.
struct Run {
  double z = 0, p = 0, count = 0, s = 1;
  std::size_t lo = 0, hi = 0;
};

// Returns single cells and aligned runs of 4, 16, ... cells; at most the 64 with the largest |z|.
std::vector<Run> farthest_runs(const PooledCells& cells, double& family) {
  std::vector<Run> runs;
  const std::size_t size = cells.cells.size();
  for (std::size_t length = 1; length < size; length *= 4)
    for (std::size_t lo = 0; lo < size; lo += length) {
      const std::size_t hi = std::min(lo + length, size);
      const double q = cells.p[hi] - cells.p[lo], count = cells.observed[hi] - cells.observed[lo];
      if (q >= 1) continue;
      family += 1;
      Run run{count > 0 ? HUGE_VAL : 0.0, q, count, 1, lo, hi};
      if (q > 0) {
        const double plain = cells.n * q * (1 - q);
        // Given the sum of all cells, the uncertainty of the other cells adds to the uncertainty of the run.
        const double of_run = cells.variance[hi] - cells.variance[lo], of_others = cells.variance.back() - of_run;
        const double variance =
            plain * cells.dispersion(lo, hi) + sqr(cells.n) * (of_run * sqr(1 - q) + std::max(of_others, 0.0) * sqr(q));
        run.z = (count - cells.n * q) / std::sqrt(variance);
        run.s = plain / variance;
      }
      if (std::abs(run.z) > 2.5) runs.push_back(run);
    }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return std::abs(a.z) > std::abs(b.z); });
  if (runs.size() > 64) runs.resize(64);
  return runs;
}

} // namespace

// Exact binomial tails of single cells and of tree nodes; the smallest p of all.
FitTest single_cells_test(const FitSetup&, double share) {
  return make_cell_test([share](const PooledCells& cells, const FitSetup& setup) {
    double family = 0, least = 1;
    const std::vector<Run> runs = farthest_runs(cells, family);
    if (family == 0) return Findings{};
    const double n = cells.n, alpha = setup.options.alpha;
    Run worst;
    for (const Run& r : runs) {
      const double p = binomial_tail(r.s * r.count, r.s * n, std::clamp(r.p, 0.0, 1.0));
      if (p >= least) continue;
      least = p;
      worst = r;
    }
    const std::string counts =
        worst.hi - worst.lo == 1 ? "count of one cell" : fmt::format("count of {} adjacent cells", worst.hi - worst.lo);
    Findings found;
    found.checks = {statistical_check("single cells", sidak(least, family), worst.z, share, alpha, Fault::local,
                                      fmt::format("the {} is off by {:.2g} standard deviations", counts, worst.z))};
    const double expected = n / static_cast<double>(cells.cells.size());
    const double variance = cells.dispersion() + n * cells.variance.back();
    const double sigmas = normal_quantile(1 - std::pow(1 - sidak_level(alpha, share), 1 / family)) + 2.326;
    found.detectable_cell =
        margin_of_region * factor_across_cells(setup.subject.dim) * sigmas * std::sqrt(variance / expected);
    return found;
  });
}

} // namespace mc
