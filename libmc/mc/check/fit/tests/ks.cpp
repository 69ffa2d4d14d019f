#include <mc/check/fit/tests/fit_test.h>
#include <mc/stats/ks_test.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

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

} // namespace

// Kolmogorov-Smirnov along each axis, on the cells, which makes it conservative.
FitTest ks_test_of_cells(const FitSetup&, double share) {
  return make_cell_test([share](const PooledCells& cells, const FitSetup& setup) {
    Findings found;
    const int dim = setup.subject.dim;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
      const double n = cells.n, worst = largest_cumulative_excess(cells, axis);
      const double lambda = std::abs(worst) / std::sqrt(n * cells.dispersion() + n * n * cells.variance.back());
      const std::string name = axis_name(setup.subject.axes, axis);
      found.checks.push_back(statistical_check(
          "KS, " + name, kolmogorov_tail(lambda), std::abs(worst) / n, share / dim, setup.options.alpha, Fault::shape,
          fmt::format("the cumulative distribution along {} is off by {:.3g}", name, worst / n)));
    }
    return found;
  });
}

} // namespace mc
