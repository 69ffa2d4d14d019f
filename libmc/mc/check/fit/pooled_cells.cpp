#include <mc/check/fit/pooled_cells.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

constexpr double least_expected = 8;

void join(Cell& a, const Cell& b) {
  a.p += b.p;
  a.variance += b.variance;
  a.observed += b.observed;
  a.squares += b.squares;
  for (std::size_t d = 0; d < max_chart_dim; ++d) {
    a.rank_lo[d] = std::min(a.rank_lo[d], b.rank_lo[d]);
    a.rank_hi[d] = std::max(a.rank_hi[d], b.rank_hi[d]);
  }
}

} // namespace

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

double factor_across_cells(int dim) {
  const double axes = std::max(dim, 1), w = std::pow(4.0, 1 / axes);
  return std::pow(1 - 1 / (3 * w), -0.5 * axes);
}

} // namespace mc
