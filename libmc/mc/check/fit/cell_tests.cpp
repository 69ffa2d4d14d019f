#include <mc/check/fit/cell_tests.h>

#include <mc/core/types.h>
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

// Means over [a, b] of ln r, ln(1 - r).
double mean_log(double a, double b) {
  const auto f = [](double r) { return r > 0 ? r * std::log(r) - r : 0.0; };
  return b - a > 1e-9 ? (f(b) - f(a)) / (b - a) : std::log(std::max(0.5 * (a + b), 1e-9));
}

struct Tester {
  std::vector<Cell> cells;
  int dim;
  double alpha;
  double n = 0;
  std::vector<double> p, error, observed; // prefix sums
  CellTests result;

  double level(double share) const { return sidak_level(alpha, share); }

  // Rejects on the statistic that the quadrature error leaves; `bias` is what that error could add to a standard normal
  // (dof 1) or to the root of a chi-square.
  void add(std::string name, double statistic, double dof, double bias, double share, Fault fault, std::string detail) {
    const auto tail = [&](double root) { return chi_square_tail(sqr(std::max(root, 0.0)), dof); };
    const double root = std::sqrt(statistic);
    const bool sure = tail(root - bias) <= level(share);
    const bool blunt = sqr(bias) > 0.15 * std::sqrt(2 * dof);
    Check c{std::move(name), Verdict::pass, tail(root), share, statistic, 0, fault, {}};
    // An immaterial error is simply conceded to the sampler, in p as in the verdict.
    if (!blunt) c.p = tail(root - bias);
    if (sure) c.verdict = Verdict::fail;
    else if (blunt) c.verdict = Verdict::inconclusive;
    if (c.verdict != Verdict::pass) c.detail = std::move(detail);
    if (c.verdict == Verdict::inconclusive) c.detail += fmt::format("; quadrature error could add {:.2g} sigma", bias);
    result.checks.push_back(std::move(c));
  }

  void pool() {
    const double total =
        std::accumulate(cells.begin(), cells.end(), 0.0, [](double s, const Cell& c) { return s + c.p; });
    for (const Cell& c : cells) n += static_cast<double>(c.observed);
    std::vector<Cell> pooled;
    Cell next;
    bool empty = true;
    const auto join = [](Cell& a, const Cell& b) {
      a.p += b.p, a.error += b.error, a.observed += b.observed;
      for (std::size_t d = 0; d < 3; ++d)
        a.rank_lo[d] = std::min(a.rank_lo[d], b.rank_lo[d]), a.rank_hi[d] = std::max(a.rank_hi[d], b.rank_hi[d]);
    };
    for (const Cell& c : cells) {
      if (empty) next = c, empty = false;
      else join(next, c);
      if (n * next.p >= least_expected) pooled.push_back(next), empty = true;
    }
    if (!empty) {
      if (pooled.empty()) pooled.push_back(next);
      else join(pooled.back(), next);
    }
    cells = std::move(pooled);
    // Conditional on the whole, so that a wrong normalisation is one fault (of mass), not hundreds.
    p.assign(1, 0), error.assign(1, 0), observed.assign(1, 0);
    for (Cell& c : cells) {
      if (total > 0) c.p /= total, c.error /= total;
      p.push_back(p.back() + c.p);
      error.push_back(error.back() + c.error);
      observed.push_back(observed.back() + static_cast<double>(c.observed));
    }
  }

  struct Group {
    double statistic = 0, dof = 0, bias = 0, expected = 0;
  };

  // Chi-squares of pairs of tree levels, from the coarsest.
  void levels(double share) {
    std::vector<Group> groups;
    struct Node {
      std::size_t lo, hi;
      int level;
    };
    std::vector<Node> stack{{0, cells.size(), 0}};
    while (!stack.empty()) {
      const Node node = stack.back();
      stack.pop_back();
      if (node.hi - node.lo < 2) continue;
      // Aligned halves: the largest power of two below the size, so that tree nodes stay whole when atoms follow them.
      std::size_t half = 1;
      while (2 * half < node.hi - node.lo) half *= 2;
      const std::size_t mid = node.lo + half;
      const double whole = p[node.hi] - p[node.lo], q = (p[mid] - p[node.lo]) / whole;
      const double count = observed[node.hi] - observed[node.lo], left = observed[mid] - observed[node.lo];
      const double variance = count * q * (1 - q);
      if (whole > 0 && variance >= 2) {
        const auto g = static_cast<std::size_t>(node.level / 2);
        if (groups.size() <= g) groups.resize(g + 1);
        groups[g].statistic += sqr(left - count * q) / variance;
        groups[g].dof += 1;
        const double e_left = error[mid] - error[node.lo], e_right = error[node.hi] - error[mid];
        groups[g].bias += sqr(count * (e_left * (1 - q) + e_right * q) / whole) / variance;
      }
      stack.push_back({node.lo, mid, node.level + 1});
      stack.push_back({mid, node.hi, node.level + 1});
    }
    std::erase_if(groups, [](const Group& g) { return g.dof == 0; });
    const double each = share / static_cast<double>(std::max<std::size_t>(groups.size(), 1));
    double coarse = 1;
    for (const Group& g : groups) {
      const double fine = coarse + g.dof;
      add(fmt::format("chi-square, {:.0f} to {:.0f} cells", coarse, fine), g.statistic, g.dof, std::sqrt(g.bias), each,
          Fault::shape, fmt::format("{:.0f} expected", g.dof));
      coarse = fine;
    }
    if (!groups.empty()) {
      // A random sign per cell puts the share dof / cells of its noncentrality n e^2 into the finest group.
      const Group& finest = groups.back();
      const double lambda = chi_square_noncentrality(finest.dof, level(each), 0.99);
      result.detectable = std::sqrt(lambda * static_cast<double>(cells.size()) / finest.dof / n);
    }
  }

  void tails(int axis, double share) {
    const auto a = static_cast<std::size_t>(axis);
    // Score functions and their covariance under the claimed probabilities.
    std::array<double, 2> mean{}, sum{}, bias{};
    std::array<double, 3> second{};
    double extreme = 0;
    for (const Cell& c : cells) {
      const std::array<double, 2> s{mean_log(c.rank_lo[a], c.rank_hi[a]), mean_log(1 - c.rank_hi[a], 1 - c.rank_lo[a])};
      for (std::size_t i = 0; i < 2; ++i) {
        mean[i] += c.p * s[i];
        sum[i] += static_cast<double>(c.observed) * s[i];
        bias[i] += c.error * std::abs(s[i]);
      }
      second[0] += c.p * s[0] * s[0], second[1] += c.p * s[0] * s[1], second[2] += c.p * s[1] * s[1];
      extreme = std::max({extreme, -s[0], -s[1]});
    }
    const double v00 = n * (second[0] - mean[0] * mean[0]), v01 = n * (second[1] - mean[0] * mean[1]),
                 v11 = n * (second[2] - mean[1] * mean[1]);
    const double det = v00 * v11 - v01 * v01;
    if (!(det > 1e-9 * v00 * v11) || !(v00 > sqr(4 * extreme)))
      return; // too few cells, or too few samples for normality
    const double x = sum[0] - n * mean[0], y = sum[1] - n * mean[1];
    const double statistic = (v11 * x * x - 2 * v01 * x * y + v00 * y * y) / det;
    const double shift = n * (bias[0] / std::sqrt(v00) + bias[1] / std::sqrt(v11));
    add(fmt::format("tails, axis {}", axis), statistic, 2, shift, share, Fault::shape,
        fmt::format("mean ln r off by {:.3g}, mean ln(1-r) by {:.3g}", x / n, y / n));
  }

  void interaction(int axis, int other, double share) {
    const auto a = static_cast<std::size_t>(axis), b = static_cast<std::size_t>(other);
    double mean = 0, second = 0, sum = 0, bias = 0;
    for (const Cell& c : cells) {
      const double s = (c.rank_lo[a] + c.rank_hi[a] - 1) * (c.rank_lo[b] + c.rank_hi[b] - 1);
      mean += c.p * s, second += c.p * s * s, sum += static_cast<double>(c.observed) * s, bias += c.error * std::abs(s);
    }
    const double variance = n * (second - mean * mean);
    if (!(variance > 16)) return;
    add(fmt::format("correlation, axes {} and {}", axis, other), sqr(sum - n * mean) / variance, 1,
        n * bias / std::sqrt(variance), share, Fault::shape, fmt::format("off by {:.3g}", (sum - n * mean) / n));
  }

  void ks(int axis, double share) {
    const auto a = static_cast<std::size_t>(axis);
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return cells[i].rank_lo[a] + cells[i].rank_hi[a] < cells[j].rank_lo[a] + cells[j].rank_hi[a];
    });
    double excess = 0, drift = 0, worst = 0, drift_at = 0;
    for (const std::size_t i : order) {
      excess += static_cast<double>(cells[i].observed) - n * cells[i].p;
      drift += cells[i].error;
      if (std::abs(excess) > std::abs(worst)) worst = excess, drift_at = n * drift;
    }
    const double lambda = std::abs(worst) / std::sqrt(n), bias = drift_at / std::sqrt(n);
    Check c{fmt::format("KS, axis {}", axis),
            Verdict::pass,
            kolmogorov_tail(lambda),
            share,
            lambda / std::sqrt(n),
            0,
            Fault::shape,
            {}};
    if (kolmogorov_tail(std::max(lambda - bias, 0.0)) <= level(share)) c.verdict = Verdict::fail;
    else if (bias > 0.3) c.verdict = Verdict::inconclusive;
    else c.p = kolmogorov_tail(std::max(lambda - bias, 0.0));
    if (c.verdict != Verdict::pass) c.detail = fmt::format("D = {:.3g}", worst / n);
    result.checks.push_back(std::move(c));
  }

  void single_cells(double share) {
    struct Candidate {
      double z, p, error, count;
      std::size_t lo, hi;
    };
    std::vector<Candidate> candidates;
    double family = 0;
    for (std::size_t size = 1; size < cells.size(); size *= 4)
      for (std::size_t lo = 0; lo < cells.size(); lo += size) {
        const std::size_t hi = std::min(lo + size, cells.size());
        const double q = p[hi] - p[lo], count = observed[hi] - observed[lo];
        if (q >= 1) continue;
        family += 1;
        const double z = q > 0 ? (count - n * q) / std::sqrt(n * q * (1 - q)) : (count > 0 ? HUGE_VAL : 0.0);
        if (std::abs(z) > 2.5) candidates.push_back({z, q, error[hi] - error[lo], count, lo, hi});
      }
    if (family == 0) return;
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return std::abs(a.z) > std::abs(b.z); });
    if (candidates.size() > 64) candidates.resize(64);
    double least = 1, least_sure = 1, z = 0, at = 0, bias = 0;
    const auto tail = [&](double count, double q) {
      return binomial_tail(static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(n), std::clamp(q, 0.0, 1.0));
    };
    for (const Candidate& c : candidates) {
      const double raw = tail(c.count, c.p);
      // The error bound moves the expected count towards the observed one, at most all the way.
      const double observed_share = c.count / n;
      const double kinder = c.z > 0 ? std::min(c.p + c.error, observed_share) : std::max(c.p - c.error, observed_share);
      least_sure = std::min(least_sure, tail(c.count, kinder));
      if (raw < least)
        least = raw, z = c.z, at = static_cast<double>(c.hi - c.lo),
        bias = c.error * std::sqrt(n / std::max(c.p, 1 / n));
    }
    Check c{"cells", Verdict::pass, sidak(least, family), share, z, 0, Fault::local, {}};
    if (sidak(least_sure, family) <= level(share)) c.verdict = Verdict::fail;
    else if (*c.p <= level(share) && bias > 0.5) c.verdict = Verdict::inconclusive;
    else c.p = sidak(least_sure, family);
    if (c.verdict != Verdict::pass) c.detail = fmt::format("a run of {:.0f} cells is {:.2g} sigma off", at, z);
    result.checks.push_back(std::move(c));
    const double expected = n / static_cast<double>(cells.size());
    result.detectable_cell =
        (normal_quantile(1 - std::pow(1 - level(share), 1 / family)) + 2.326) / std::sqrt(expected);
  }
};

} // namespace

CellTests test_cells(std::vector<Cell> cells, int dim, double alpha) {
  Tester t{std::move(cells), dim, alpha, 0, {}, {}, {}, {}};
  t.pool();
  if (t.cells.size() < 2 || t.n == 0) return {};
  // Shares of alpha: the scores are the most powerful against the faults that samplers have. 0.09 is left to
  //                  check_subject.
  const double axes = std::max(dim, 1);
  t.levels(dim > 0 ? 0.26 : 0.61);
  t.single_cells(dim > 0 ? 0.15 : 0.3);
  for (int axis = 0; axis < dim; ++axis) {
    t.tails(axis, 0.3 / axes);
    t.ks(axis, (dim > 1 ? 0.14 : 0.2) / axes);
    for (int other = 0; other < axis; ++other) t.interaction(other, axis, 0.06 / (axes * (axes - 1) / 2));
  }
  return std::move(t.result);
}

} // namespace mc
