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

// Factor for errors that do not follow the cells. Their patches, or their region, have the probability of four cells
// and cross the borders of cells. Cells at random offsets over patches w cells wide retain 1 - 1 / (3 w) of the square
// of a random sign along each axis. The margins below cover patches that are rotated or longer than wide;
// `bench_mc_check_error_rates promise` tests them.
double across_cells(int dim) {
  const double axes = std::max(dim, 1), w = std::pow(4.0, 1 / axes);
  return std::pow(1 - 1 / (3 * w), -0.5 * axes);
}
constexpr double margin_of_signs = 1.25, margin_of_region = 1.04;

/// Cells with at least 8 expected samples each, given the sum of the samples.
struct PooledCells {
  std::vector<Cell> cells;
  double n = 0;
  std::vector<double> p{0}, variance{0}, observed{0}, squares{0}; // prefix sums

  // Returns the variance of the sum of the weights in the cells [lo, hi), divided by its expectation.
  double dispersion(std::size_t lo, std::size_t hi) const {
    const double count = observed[hi] - observed[lo];
    return count > 0 ? (squares[hi] - squares[lo]) / count : 1.0;
  }
  double dispersion() const { return dispersion(0, cells.size()); }
};

void join(Cell& a, const Cell& b) {
  a.p += b.p;
  a.variance += b.variance;
  a.observed += b.observed;
  a.squares += b.squares;
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
    pooled.n += c.observed;
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
  // Conditional on the total: a wrong normalisation is a single fault (mass), instead of hundreds.
  for (Cell& c : pooled.cells) {
    if (total > 0) {
      c.p /= total;
      c.variance /= total * total;
    }
    pooled.p.push_back(pooled.p.back() + c.p);
    pooled.variance.push_back(pooled.variance.back() + c.variance);
    pooled.observed.push_back(pooled.observed.back() + c.observed);
    pooled.squares.push_back(pooled.squares.back() + c.squares);
  }
  return pooled;
}

Check chi_square_check(std::string name, double statistic, double dof, double share, double alpha,
                       const std::string& detail) {
  Check c{std::move(name), Verdict::pass, chi_square_tail(statistic, dof), share, statistic, 0, Fault::shape, {}};
  if (*c.p > sidak_level(alpha, share)) return c;
  c.verdict = Verdict::fail;
  c.detail = detail;
  return c;
}

// The chi-square of two levels of the tree.
struct TreeLevels {
  /// Noise: variance of the probabilities, relative to the variance of the counts.
  double statistic = 0, dof = 0, noise = 0;
};

void add_split(const PooledCells& cells, std::size_t lo, std::size_t mid, std::size_t hi, TreeLevels& levels) {
  const double whole = cells.p[hi] - cells.p[lo], q = (cells.p[mid] - cells.p[lo]) / whole;
  const double count = cells.observed[hi] - cells.observed[lo], left = cells.observed[mid] - cells.observed[lo];
  const double counted = count * q * (1 - q) * cells.dispersion(lo, hi);
  if (!(whole > 0 && counted >= 2)) return;
  const double v_left = cells.variance[mid] - cells.variance[lo], v_right = cells.variance[hi] - cells.variance[mid];
  const double estimated = sqr(count / whole) * (v_left * sqr(1 - q) + v_right * sqr(q));
  levels.statistic += sqr(left - count * q) / (counted + estimated);
  levels.dof += 1;
  levels.noise += estimated / counted;
}

// Returns pairs of levels, the coarsest first.
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
    // Aligned halves: the largest power of two below the size keeps tree nodes whole when atoms follow them.
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

void chi_squares(const PooledCells& cells, int dim, double share, double alpha, CellTests& result) {
  const std::vector<TreeLevels> groups = tree_levels(cells);
  if (groups.empty()) return;
  const double each = share / static_cast<double>(groups.size());
  double coarse = 1;
  for (const TreeLevels& g : groups) {
    const double fine = coarse + g.dof;
    result.checks.push_back(chi_square_check(fmt::format("chi-square, {:.0f} to {:.0f} cells", coarse, fine),
                                             g.statistic, g.dof, each, alpha,
                                             fmt::format("chi-square is {:.4g}, {:.0f} expected", g.statistic, g.dof)));
    coarse = fine;
  }
  // A random sign per cell puts the fraction dof / cells of its noncentrality n e^2 into the finest group.
  const double dof = groups.back().dof, lambda = chi_square_noncentrality(dof, sidak_level(alpha, each), 0.99);
  const double noise = 1 + groups.back().noise / dof;
  result.detectable = margin_of_signs * across_cells(dim) *
                      std::sqrt(lambda * noise * static_cast<double>(cells.cells.size()) / dof / cells.n);
}

// Returns the mean of ln r over [a, b].
double mean_log(double a, double b) {
  const auto f = [](double r) { return r > 0 ? r * std::log(r) - r : 0.0; };
  return b - a > 1e-9 ? (f(b) - f(a)) / (b - a) : std::log(std::max(0.5 * (a + b), 1e-9));
}

// Adds no check if there are too few cells, or too few samples for a normal approximation.
void tails(const PooledCells& cells, const std::vector<Axis>& named, std::size_t axis, double share, double alpha,
           CellTests& result) {
  std::vector<std::array<double, 2>> scores;
  std::array<double, 2> mean{}, sum{};
  double extreme = 0;
  for (const Cell& c : cells.cells) {
    const std::array<double, 2> s{mean_log(c.rank_lo[axis], c.rank_hi[axis]),
                                  mean_log(1 - c.rank_hi[axis], 1 - c.rank_lo[axis])};
    for (std::size_t i = 0; i < 2; ++i) {
      mean[i] += c.p * s[i];
      sum[i] += c.observed * s[i];
    }
    extreme = std::max({extreme, -s[0], -s[1]});
    scores.push_back(s);
  }
  // Covariance of the scores under the claimed probabilities.
  const double n = cells.n, dispersion = cells.dispersion();
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const double a = scores[k][0] - mean[0], b = scores[k][1] - mean[1];
    const double variance = n * dispersion * cells.cells[k].p + n * n * cells.cells[k].variance;
    v[0] += variance * a * a;
    v[1] += variance * a * b;
    v[2] += variance * b * b;
  }
  const double det = v[0] * v[2] - v[1] * v[1];
  if (!(det > 1e-9 * v[0] * v[2]) || !(v[0] > sqr(4 * extreme))) return;
  const double x = sum[0] - n * mean[0], y = sum[1] - n * mean[1];
  result.checks.push_back(chi_square_check(
      "tails, " + axis_name(named, axis), (v[2] * x * x - 2 * v[1] * x * y + v[0] * y * y) / det, 2, share, alpha,
      fmt::format("mean of ln r is off by {:.3g}, mean of ln(1 - r) by {:.3g}, where r is the rank "
                  "along {}",
                  x / n, y / n, axis_name(named, axis))));
}

void correlation(const PooledCells& cells, const std::vector<Axis>& named, std::size_t a, std::size_t b, double share,
                 double alpha, CellTests& result) {
  const auto score = [&](const Cell& c) {
    return (c.rank_lo[a] + c.rank_hi[a] - 1) * (c.rank_lo[b] + c.rank_hi[b] - 1);
  };
  double mean = 0, sum = 0, variance = 0;
  for (const Cell& c : cells.cells) {
    mean += c.p * score(c);
    sum += c.observed * score(c);
  }
  const double n = cells.n, dispersion = cells.dispersion();
  for (const Cell& c : cells.cells) variance += (n * dispersion * c.p + n * n * c.variance) * sqr(score(c) - mean);
  if (!(variance > 16)) return;
  result.checks.push_back(chi_square_check(
      fmt::format("correlation, {} and {}", axis_name(named, a), axis_name(named, b)), sqr(sum - n * mean) / variance,
      1, share, alpha, fmt::format("the rank correlation is off by {:.3g}", (sum - n * mean) / n)));
}

// Returns the largest difference of the cumulative distributions along an axis. Each cell spreads its excess evenly
// over its ranks, so that an error along another axis, which changes cells of any width, cancels.
double largest_cumulative_excess(const PooledCells& cells, std::size_t axis) {
  struct Event {
    double rank, slope, jump;
  };
  std::vector<Event> events;
  for (const Cell& c : cells.cells) {
    const double excess = c.observed - cells.n * c.p, lo = c.rank_lo[axis], width = c.rank_hi[axis] - lo;
    if (width > 0) {
      events.push_back({lo, excess / width, 0});
      events.push_back({c.rank_hi[axis], -excess / width, 0});
    } else {
      events.push_back({lo, 0, excess});
    }
  }
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.rank < b.rank; });
  double excess = 0, slope = 0, at = 0, worst = 0;
  for (const Event& e : events) {
    excess += slope * (e.rank - at);
    at = e.rank;
    if (std::abs(excess) > std::abs(worst)) worst = excess;
    slope += e.slope;
    excess += e.jump;
    if (std::abs(excess) > std::abs(worst)) worst = excess;
  }
  return worst;
}

void ks(const PooledCells& cells, const std::vector<Axis>& named, std::size_t axis, double share, double alpha,
        CellTests& result) {
  const double n = cells.n, worst = largest_cumulative_excess(cells, axis);
  const double lambda = std::abs(worst) / std::sqrt(n * cells.dispersion() + n * n * cells.variance.back());
  Check c{"KS, " + axis_name(named, axis),
          Verdict::pass,
          kolmogorov_tail(lambda),
          share,
          std::abs(worst) / n,
          0,
          Fault::shape,
          {}};
  if (*c.p <= sidak_level(alpha, share)) {
    c.verdict = Verdict::fail;
    c.detail = fmt::format("the cumulative distribution along {} is off by {:.3g}", axis_name(named, axis), worst / n);
  }
  result.checks.push_back(std::move(c));
}

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

void single_cells(const PooledCells& cells, int dim, double share, double alpha, CellTests& result) {
  double family = 0, least = 1;
  const std::vector<Run> runs = farthest_runs(cells, family);
  if (family == 0) return;
  const double n = cells.n, level = sidak_level(alpha, share);
  Run worst;
  for (const Run& r : runs) {
    const double p = binomial_tail(r.s * r.count, r.s * n, std::clamp(r.p, 0.0, 1.0));
    if (p >= least) continue;
    least = p;
    worst = r;
  }
  Check c{"single cells", Verdict::pass, sidak(least, family), share, worst.z, 0, Fault::local, {}};
  if (*c.p <= level) {
    c.verdict = Verdict::fail;
    c.detail = worst.hi - worst.lo == 1
                   ? fmt::format("the count of one cell is off by {:.2g} standard deviations", worst.z)
                   : fmt::format("the count of {} adjacent cells is off by {:.2g} standard deviations",
                                 worst.hi - worst.lo, worst.z);
  }
  result.checks.push_back(std::move(c));
  const double expected = n / static_cast<double>(cells.cells.size());
  const double variance = cells.dispersion() + n * cells.variance.back();
  const double sigmas = normal_quantile(1 - std::pow(1 - level, 1 / family)) + 2.326;
  result.detectable_cell = margin_of_region * across_cells(dim) * sigmas * std::sqrt(variance / expected);
}

} // namespace

CellTests test_cells(const std::vector<Cell>& counted, int dim, double alpha, const std::vector<Axis>& named) {
  const PooledCells cells = pool(counted);
  CellTests result;
  if (cells.cells.size() < 2 || cells.n == 0) return result;
  const auto share = [dim](FitTest test) { return alpha_share(test, dim); };
  chi_squares(cells, dim, share(FitTest::chi_square), alpha, result);
  single_cells(cells, dim, share(FitTest::single_cells), alpha, result);
  const double axes = std::max(dim, 1), pairs = std::max(axes * (axes - 1) / 2, 1.0);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
    tails(cells, named, axis, share(FitTest::tails) / axes, alpha, result);
    ks(cells, named, axis, share(FitTest::ks) / axes, alpha, result);
    for (std::size_t other = 0; other < axis; ++other)
      correlation(cells, named, other, axis, share(FitTest::correlation) / pairs, alpha, result);
  }
  return result;
}

} // namespace mc
