#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <cmath>

namespace mc {
namespace {

constexpr double margin_of_signs = 1.25; // patches may be rotated, or longer than wide

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

} // namespace

// The cells form a binary tree in their order. At each node the left half of the count is binomial and independent of
// all other nodes. The levels therefore give independent chi-squares, each sensitive to errors of its own scale.
FitTest chi_square_test(const FitSetup&, double share) {
  return make_cell_test([share](const PooledCells& cells, const FitSetup& setup) {
    Findings found;
    const std::vector<TreeLevels> groups = tree_levels(cells);
    if (groups.empty()) return found;
    const double each = share / static_cast<double>(groups.size()), alpha = setup.options.alpha;
    double coarse = 1;
    for (const TreeLevels& g : groups) {
      const double fine = coarse + g.dof;
      found.checks.push_back(
          statistical_check(fmt::format("chi-square, {:.0f} to {:.0f} cells", coarse, fine),
                            chi_square_tail(g.statistic, g.dof), g.statistic, each, alpha, Fault::shape,
                            fmt::format("chi-square is {:.4g}, {:.0f} expected", g.statistic, g.dof)));
      coarse = fine;
    }
    // A random sign per cell puts the fraction dof / cells of its noncentrality n e^2 into the finest group.
    const double dof = groups.back().dof, lambda = chi_square_noncentrality(dof, sidak_level(alpha, each), 0.99);
    const double noise = 1 + groups.back().noise / dof;
    found.detectable = margin_of_signs * factor_across_cells(setup.subject.dim) *
                       std::sqrt(lambda * noise * static_cast<double>(cells.cells.size()) / dof / cells.n);
    return found;
  });
}

} // namespace mc
