#include <mc/check/fit/tests/cell_tests.h>

#include <mc/check/fit/alpha_shares.h>
#include <mc/core/types.h>
#include <mc/stats/binomial.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/ks_test.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr double least_expected = 8;

/// Cells that expect at least 8 samples each, given their sum.
struct PooledCells {
  std::vector<Cell> cells;
  double n = 0;
  std::vector<double> p{0}, error{0}, observed{0}; // prefix sums
};

void join(Cell& a, const Cell& b) {
  a.p += b.p;
  a.error += b.error;
  a.observed += b.observed;
  for (std::size_t d = 0; d < 3; ++d) {
    a.rank_lo[d] = std::min(a.rank_lo[d], b.rank_lo[d]);
    a.rank_hi[d] = std::max(a.rank_hi[d], b.rank_hi[d]);
  }
}

PooledCells pool(const std::vector<Cell>& cells) {
  PooledCells pooled;
  double total = 0;
  for (const Cell& c : cells) {
    total += c.p;
    pooled.n += static_cast<double>(c.observed);
  }
  Cell next;
  bool empty = true;
  for (const Cell& c : cells) {
    if (empty) next = c;
    else join(next, c);
    empty = pooled.n * next.p >= least_expected;
    if (empty) pooled.cells.push_back(next);
  }
  if (!empty && pooled.cells.empty()) pooled.cells.push_back(next);
  else if (!empty) join(pooled.cells.back(), next);
  // Conditional on the whole, so that a wrong normalisation is one fault (of mass), not hundreds.
  for (Cell& c : pooled.cells) {
    if (total > 0) {
      c.p /= total;
      c.error /= total;
    }
    pooled.p.push_back(pooled.p.back() + c.p);
    pooled.error.push_back(pooled.error.back() + c.error);
    pooled.observed.push_back(pooled.observed.back() + static_cast<double>(c.observed));
  }
  return pooled;
}

// A test of a chi-square statistic of which the quadrature error may be a part: `bias` is what it could add to a
// standard normal (dof 1) or to the root of a chi-square.
Check chi_square_check(std::string name, double statistic, double dof, double bias, double share, double alpha,
                       const std::string& detail) {
  const auto tail = [&](double root) { return chi_square_tail(sqr(std::max(root, 0.0)), dof); };
  const double root = std::sqrt(statistic);
  const bool blunt = sqr(bias) > 0.15 * std::sqrt(2 * dof);
  // An immaterial error is simply conceded to the sampler, in p as in the verdict.
  Check c{std::move(name), Verdict::pass, tail(blunt ? root : root - bias), share, statistic, 0, Fault::shape, {}};
  if (tail(root - bias) <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else if (blunt) c.verdict = Verdict::inconclusive;
  if (c.verdict != Verdict::pass) c.detail = detail;
  if (c.verdict == Verdict::inconclusive) c.detail += fmt::format("; quadrature error could add {:.2g} sigma", bias);
  return c;
}

// The chi-square of two levels of the tree.
struct TreeLevels {
  double statistic = 0, dof = 0, bias = 0;
};

void add_split(const PooledCells& cells, std::size_t lo, std::size_t mid, std::size_t hi, TreeLevels& levels) {
  const double whole = cells.p[hi] - cells.p[lo], q = (cells.p[mid] - cells.p[lo]) / whole;
  const double count = cells.observed[hi] - cells.observed[lo], left = cells.observed[mid] - cells.observed[lo];
  const double variance = count * q * (1 - q);
  if (!(whole > 0 && variance >= 2)) return;
  const double e_left = cells.error[mid] - cells.error[lo], e_right = cells.error[hi] - cells.error[mid];
  levels.statistic += sqr(left - count * q) / variance;
  levels.dof += 1;
  levels.bias += sqr(count * (e_left * (1 - q) + e_right * q) / whole) / variance;
}

// From the coarsest.
std::vector<TreeLevels> tree_levels(const PooledCells& cells) {
  struct Node {
    std::size_t lo, hi, level;
  };
  std::vector<TreeLevels> groups;
  std::vector<Node> stack{{0, cells.cells.size(), 0}};
  while (!stack.empty()) {
    const Node node = stack.back();
    stack.pop_back();
    if (node.hi - node.lo < 2) continue;
    // Aligned halves: the largest power of two below the size, so that tree nodes stay whole when atoms follow them.
    std::size_t half = 1;
    while (2 * half < node.hi - node.lo) half *= 2;
    const std::size_t mid = node.lo + half;
    if (groups.size() <= node.level / 2) groups.resize(node.level / 2 + 1);
    add_split(cells, node.lo, mid, node.hi, groups[node.level / 2]);
    stack.push_back({node.lo, mid, node.level + 1});
    stack.push_back({mid, node.hi, node.level + 1});
  }
  std::erase_if(groups, [](const TreeLevels& g) { return g.dof == 0; });
  return groups;
}

void chi_squares(const PooledCells& cells, double share, double alpha, CellTests& result) {
  const std::vector<TreeLevels> groups = tree_levels(cells);
  if (groups.empty()) return;
  const double each = share / static_cast<double>(groups.size());
  double coarse = 1;
  for (const TreeLevels& g : groups) {
    const double fine = coarse + g.dof;
    result.checks.push_back(chi_square_check(fmt::format("chi-square, {:.0f} to {:.0f} cells", coarse, fine),
                                             g.statistic, g.dof, std::sqrt(g.bias), each, alpha,
                                             fmt::format("{:.0f} expected", g.dof)));
    coarse = fine;
  }
  // A random sign per cell puts the share dof / cells of its noncentrality n e^2 into the finest group.
  const double dof = groups.back().dof, lambda = chi_square_noncentrality(dof, sidak_level(alpha, each), 0.99);
  result.detectable = std::sqrt(lambda * static_cast<double>(cells.cells.size()) / dof / cells.n);
}

// Means over [a, b] of ln r, ln(1 - r).
double mean_log(double a, double b) {
  const auto f = [](double r) { return r > 0 ? r * std::log(r) - r : 0.0; };
  return b - a > 1e-9 ? (f(b) - f(a)) / (b - a) : std::log(std::max(0.5 * (a + b), 1e-9));
}

// Nothing where there are too few cells, or too few samples for normality.
void tails(const PooledCells& cells, std::size_t axis, double share, double alpha, CellTests& result) {
  // Score functions and their covariance under the claimed probabilities.
  std::array<double, 2> mean{}, sum{}, bias{};
  std::array<double, 3> second{};
  double extreme = 0;
  for (const Cell& c : cells.cells) {
    const std::array<double, 2> s{mean_log(c.rank_lo[axis], c.rank_hi[axis]),
                                  mean_log(1 - c.rank_hi[axis], 1 - c.rank_lo[axis])};
    for (std::size_t i = 0; i < 2; ++i) {
      mean[i] += c.p * s[i];
      sum[i] += static_cast<double>(c.observed) * s[i];
      bias[i] += c.error * std::abs(s[i]);
    }
    second[0] += c.p * s[0] * s[0];
    second[1] += c.p * s[0] * s[1];
    second[2] += c.p * s[1] * s[1];
    extreme = std::max({extreme, -s[0], -s[1]});
  }
  const double n = cells.n;
  const double v00 = n * (second[0] - mean[0] * mean[0]), v01 = n * (second[1] - mean[0] * mean[1]),
               v11 = n * (second[2] - mean[1] * mean[1]);
  const double det = v00 * v11 - v01 * v01;
  if (!(det > 1e-9 * v00 * v11) || !(v00 > sqr(4 * extreme))) return;
  const double x = sum[0] - n * mean[0], y = sum[1] - n * mean[1];
  const double statistic = (v11 * x * x - 2 * v01 * x * y + v00 * y * y) / det;
  const double shift = n * (bias[0] / std::sqrt(v00) + bias[1] / std::sqrt(v11));
  result.checks.push_back(
      chi_square_check(fmt::format("tails, axis {}", axis), statistic, 2, shift, share, alpha,
                       fmt::format("mean ln r off by {:.3g}, mean ln(1-r) by {:.3g}", x / n, y / n)));
}

void correlation(const PooledCells& cells, std::size_t a, std::size_t b, double share, double alpha,
                 CellTests& result) {
  double mean = 0, second = 0, sum = 0, bias = 0;
  for (const Cell& c : cells.cells) {
    const double s = (c.rank_lo[a] + c.rank_hi[a] - 1) * (c.rank_lo[b] + c.rank_hi[b] - 1);
    mean += c.p * s;
    second += c.p * s * s;
    sum += static_cast<double>(c.observed) * s;
    bias += c.error * std::abs(s);
  }
  const double n = cells.n, variance = n * (second - mean * mean);
  if (!(variance > 16)) return;
  result.checks.push_back(chi_square_check(fmt::format("correlation, axes {} and {}", a, b),
                                           sqr(sum - n * mean) / variance, 1, n * bias / std::sqrt(variance), share,
                                           alpha, fmt::format("off by {:.3g}", (sum - n * mean) / n)));
}

void ks(const PooledCells& cells, std::size_t axis, double share, double alpha, CellTests& result) {
  const auto place = [&](std::size_t i) { return cells.cells[i].rank_lo[axis] + cells.cells[i].rank_hi[axis]; };
  std::vector<std::size_t> order(cells.cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return place(i) < place(j); });
  double excess = 0, drift = 0, worst = 0, drift_at = 0;
  const double n = cells.n;
  for (const std::size_t i : order) {
    excess += static_cast<double>(cells.cells[i].observed) - n * cells.cells[i].p;
    drift += cells.cells[i].error;
    if (std::abs(excess) <= std::abs(worst)) continue;
    worst = excess;
    drift_at = n * drift;
  }
  const double lambda = std::abs(worst) / std::sqrt(n), bias = drift_at / std::sqrt(n);
  const double conceded = kolmogorov_tail(std::max(lambda - bias, 0.0));
  Check c{fmt::format("KS, axis {}", axis), Verdict::pass, conceded, share, lambda / std::sqrt(n), 0, Fault::shape, {}};
  if (conceded <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else if (bias > 0.3) c.verdict = Verdict::inconclusive;
  if (c.verdict != Verdict::pass) {
    c.p = kolmogorov_tail(lambda);
    c.detail = fmt::format("D = {:.3g}", worst / n);
  }
  result.checks.push_back(std::move(c));
}

// A run of cells that is far off.
struct Run {
  double z, p, error, count;
  std::size_t lo, hi;
};

// Single cells and aligned runs of 4, 16, ... of them; of the runs only the 64 farthest off.
std::vector<Run> farthest_runs(const PooledCells& cells, double& family) {
  std::vector<Run> runs;
  const std::size_t size = cells.cells.size();
  for (std::size_t length = 1; length < size; length *= 4)
    for (std::size_t lo = 0; lo < size; lo += length) {
      const std::size_t hi = std::min(lo + length, size);
      const double q = cells.p[hi] - cells.p[lo], count = cells.observed[hi] - cells.observed[lo];
      if (q >= 1) continue;
      family += 1;
      double z = count > 0 ? HUGE_VAL : 0.0;
      if (q > 0) z = (count - cells.n * q) / std::sqrt(cells.n * q * (1 - q));
      if (std::abs(z) > 2.5) runs.push_back({z, q, cells.error[hi] - cells.error[lo], count, lo, hi});
    }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return std::abs(a.z) > std::abs(b.z); });
  if (runs.size() > 64) runs.resize(64);
  return runs;
}

void single_cells(const PooledCells& cells, double share, double alpha, CellTests& result) {
  double family = 0, least = 1, least_sure = 1;
  const std::vector<Run> runs = farthest_runs(cells, family);
  if (family == 0) return;
  const double n = cells.n, level = sidak_level(alpha, share);
  const auto tail = [&](double count, double q) {
    return binomial_tail(static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(n), std::clamp(q, 0.0, 1.0));
  };
  Run worst{};
  for (const Run& r : runs) {
    // The error bound moves the expected count towards the observed one, at most all the way.
    const double observed = r.count / n;
    const double conceded = r.z > 0 ? std::min(r.p + r.error, observed) : std::max(r.p - r.error, observed);
    least_sure = std::min(least_sure, tail(r.count, conceded));
    const double p = tail(r.count, r.p);
    if (p >= least) continue;
    least = p;
    worst = r;
  }
  const double bias = worst.error * std::sqrt(n / std::max(worst.p, 1 / n));
  Check c{"cells", Verdict::pass, sidak(least, family), share, worst.z, 0, Fault::local, {}};
  if (sidak(least_sure, family) <= level) c.verdict = Verdict::fail;
  else if (*c.p <= level && bias > 0.5) c.verdict = Verdict::inconclusive;
  else c.p = sidak(least_sure, family);
  if (c.verdict != Verdict::pass)
    c.detail = fmt::format("a run of {} cells is {:.2g} sigma off", worst.hi - worst.lo, worst.z);
  result.checks.push_back(std::move(c));
  result.detectable_cell = (normal_quantile(1 - std::pow(1 - level, 1 / family)) + 2.326) /
                           std::sqrt(n / static_cast<double>(cells.cells.size()));
}

} // namespace

CellTests test_cells(const std::vector<Cell>& counted, int dim, double alpha) {
  const PooledCells cells = pool(counted);
  CellTests result;
  if (cells.cells.size() < 2 || cells.n == 0) return result;
  const auto share = [dim](FitTest test) { return alpha_share(test, dim); };
  chi_squares(cells, share(FitTest::chi_square), alpha, result);
  single_cells(cells, share(FitTest::single_cells), alpha, result);
  const double axes = std::max(dim, 1), pairs = std::max(axes * (axes - 1) / 2, 1.0);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
    tails(cells, axis, share(FitTest::tails) / axes, alpha, result);
    ks(cells, axis, share(FitTest::ks) / axes, alpha, result);
    for (std::size_t other = 0; other < axis; ++other)
      correlation(cells, other, axis, share(FitTest::correlation) / pairs, alpha, result);
  }
  return result;
}

} // namespace mc
