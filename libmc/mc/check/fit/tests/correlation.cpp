#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>
#include <mc/stats/chi_square.h>

#include <fmt/format.h>

namespace mc {
namespace {

// Returns no check if there are too few samples for a normal approximation.
std::optional<Check> test_correlation(const PooledCells& cells, const std::vector<Axis>& named, std::size_t a,
                                      std::size_t b, double share, double alpha) {
  const auto score = [&](const Cell& c) {
    return (c.rank_lo[a] + c.rank_hi[a] - 1) * (c.rank_lo[b] + c.rank_hi[b] - 1);
  };
  double mean = 0, sum = 0, variance = 0;
  for (const Cell& c : cells.cells) {
    mean += c.p * score(c);
    sum += c.observed * score(c);
  }
  const double n = cells.n;
  for (const Cell& c : cells.cells) variance += cells.variance_of(c) * sqr(score(c) - mean);
  if (!(variance > 16)) return {};
  const double statistic = sqr(sum - n * mean) / variance;
  return statistical_check(fmt::format("correlation, {} and {}", axis_name(named, a), axis_name(named, b)),
                           chi_square_tail(statistic, 1), statistic, share, alpha, Fault::shape,
                           fmt::format("the rank correlation is off by {:.3g}", (sum - n * mean) / n));
}

} // namespace

// Per pair of axes, the rank correlation.
FitTest correlation_test(const FitSetup&, double share) {
  return make_cell_test([share](const PooledCells& cells, const FitSetup& setup) {
    Findings found;
    const int dim = setup.subject.dim;
    for (std::size_t a = 1; a < static_cast<std::size_t>(dim); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (auto c =
                test_correlation(cells, setup.subject.axes, b, a, share / (dim * (dim - 1) / 2.0), setup.options.alpha))
          found.checks.push_back(std::move(*c));
    return found;
  });
}

} // namespace mc
