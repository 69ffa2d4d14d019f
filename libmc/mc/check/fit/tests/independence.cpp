#include <mc/check/fit/tests/independence.h>

#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

// Returns the ranks of the coordinates of an axis, in (0, 1).
std::vector<double> ranks_of(std::span<const Subject::Coordinates> samples, std::size_t axis, std::uint64_t seed) {
  std::vector<std::uint32_t> order(samples.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const double a = samples[i][axis], b = samples[j][axis];
    return a != b ? a < b : hash(seed, i) < hash(seed, j);
  });
  std::vector<double> ranks(samples.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    ranks[order[k]] = (static_cast<double>(k) + 0.5) / static_cast<double>(order.size());
  return ranks;
}

Check order_check(std::string name, double p, double statistic, double share, double alpha, std::string detail) {
  Check c{std::move(name), Verdict::pass, p, share, statistic, 0, Fault::dependent, {}};
  if (p > sidak_level(alpha, share)) return c;
  c.verdict = Verdict::fail;
  c.detail = std::move(detail);
  return c;
}

Check serial_pairs(const std::vector<double>& ranks, const std::string& axis, double share, double alpha) {
  constexpr std::size_t k = 8;
  std::array<std::array<double, k>, k> counts{};
  std::array<double, k> rows{}, columns{};
  const auto bin = [](double r) { return std::min(static_cast<std::size_t>(r * static_cast<double>(k)), k - 1); };
  for (std::size_t i = 0; i + 1 < ranks.size(); i += 2) {
    const std::size_t a = bin(ranks[i]), b = bin(ranks[i + 1]);
    counts[a][b] += 1;
    rows[a] += 1;
    columns[b] += 1;
  }
  const std::size_t pairs = ranks.size() / 2;
  const auto n = static_cast<double>(pairs);
  double statistic = 0;
  for (std::size_t a = 0; a < k; ++a)
    for (std::size_t b = 0; b < k; ++b)
      if (const double expected = rows[a] * columns[b] / n; expected > 0)
        statistic += sqr(counts[a][b] - expected) / expected;
  const double dof = sqr(static_cast<double>(k - 1));
  return order_check(
      "serial pairs, " + axis, chi_square_tail(statistic, dof), statistic, share, alpha,
      fmt::format(
          "successive samples depend on each other along {}: chi-square of their pairs is {:.4g}, {:.0f} expected",
          axis, statistic, dof));
}

Check serial_correlation(const std::vector<double>& ranks, const std::string& axis, double share, double alpha) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ranks.size(); ++i) sum += (ranks[i] - 0.5) * (ranks[i + 1] - 0.5);
  const double n = static_cast<double>(ranks.size() - 1), correlation = 12 * sum / n;
  return order_check(
      "serial correlation, " + axis, normal_tail(correlation * std::sqrt(n)), correlation, share, alpha,
      fmt::format("successive samples are correlated along {}: the correlation of their ranks is {:.3g}, 0 "
                  "expected",
                  axis, correlation));
}

Check runs(const std::vector<double>& ranks, const std::string& axis, double share, double alpha) {
  double count = 1;
  for (std::size_t i = 0; i + 1 < ranks.size(); ++i) count += (ranks[i] < 0.5) != (ranks[i + 1] < 0.5);
  const double n = static_cast<double>(ranks.size()), expected = n / 2 + 1;
  return order_check(
      "runs, " + axis, normal_tail((count - expected) / std::sqrt(n / 4)), count, share, alpha,
      fmt::format("the order of the samples is not random along {}: {:.0f} runs above and below the median, "
                  "{:.0f} expected",
                  axis, count, expected));
}

} // namespace

std::vector<Check> test_order(std::span<const Subject::Coordinates> samples, const std::vector<Axis>& axes, int dim,
                              std::uint64_t seed, double share, double alpha) {
  std::vector<Check> checks;
  if (samples.size() < 1000) return checks;
  const double each = share / (3 * dim);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
    const std::vector<double> ranks = ranks_of(samples, axis, hash(seed, axis));
    const std::string name = axis_name(axes, axis);
    checks.push_back(serial_pairs(ranks, name, each, alpha));
    checks.push_back(serial_correlation(ranks, name, each, alpha));
    checks.push_back(runs(ranks, name, each, alpha));
  }
  return checks;
}

std::vector<Check> test_evenness(std::span<const double> counts, std::span<const double> probabilities, double share,
                                 double alpha) {
  const double n = std::accumulate(counts.begin(), counts.end(), 0.0),
               total = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  double statistic = 0, pooled = 0, expected = 0, observed = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    expected += n * probabilities[i] / total;
    observed += counts[i];
    if (expected < 8) continue;
    statistic += sqr(observed - expected) / expected;
    pooled += 1;
    expected = observed = 0;
  }
  if (pooled < 8) return {};
  const double dof = pooled - 1, p = 1 - chi_square_tail(statistic, dof);
  return {order_check(
      "counts not too even", p, statistic, share, alpha,
      fmt::format("the counts of {} outcomes are more even than chance allows: chi-square is {:.4g}, {:.0f} "
                  "expected",
                  counts.size(), statistic, dof))};
}

} // namespace mc
