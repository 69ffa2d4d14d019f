#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>
#include <mc/stats/chi_square.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Returns the mean of ln r over [a, b].
double mean_log(double a, double b) {
  const auto f = [](double r) { return r > 0 ? r * std::log(r) - r : 0.0; };
  return b - a > 1e-9 ? (f(b) - f(a)) / (b - a) : std::log(std::max(0.5 * (a + b), 1e-9));
}

// Returns no check if there are too few cells, or too few samples for a normal approximation.
std::optional<Check> test_tails(const PooledCells& cells, const std::string& name, std::size_t axis, double share,
                                double alpha) {
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
  const double n = cells.n;
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const double a = scores[k][0] - mean[0], b = scores[k][1] - mean[1];
    const double variance = cells.variance_of(cells.cells[k]);
    v[0] += variance * a * a;
    v[1] += variance * a * b;
    v[2] += variance * b * b;
  }
  const double det = v[0] * v[2] - v[1] * v[1];
  if (!(det > 1e-9 * v[0] * v[2]) || !(v[0] > sqr(4 * extreme))) return {};
  const double x = sum[0] - n * mean[0], y = sum[1] - n * mean[1];
  const double statistic = (v[2] * x * x - 2 * v[1] * x * y + v[0] * y * y) / det;
  return statistical_check(
      "tails, " + name, chi_square_tail(statistic, 2), statistic, share, alpha, Fault::shape,
      fmt::format("mean of ln r is off by {:.3g}, mean of ln(1 - r) by {:.3g}, where r is the rank "
                  "along {}",
                  x / n, y / n, name));
}

} // namespace

// Per axis, the means of ln r and ln(1 - r) over the ranks r of the samples, a score with two degrees of freedom.
// Powerful against wrong exponents, roughness, rotations and shifts.
FitTest tails_test(const FitSetup&, double share) {
  return make_cell_test([share](const PooledCells& cells, const FitSetup& setup) {
    Findings found;
    const int dim = setup.subject.dim;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis)
      if (auto c = test_tails(cells, axis_name(setup.subject.axes, axis), axis, share / dim, setup.options.alpha))
        found.checks.push_back(std::move(*c));
    return found;
  });
}

} // namespace mc
