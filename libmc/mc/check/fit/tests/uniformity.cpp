#include <mc/check/fit/tests/uniformity.h>

#include <mc/check/fit/tests/fit_test.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/ks_test.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {

std::optional<Check> check_inverse_finite(const Subject& s, std::uint64_t seed, std::size_t n,
                                          const std::vector<Subject::Coordinates>& inverted) {
  const auto is_lost = [](const Subject::Coordinates& u) {
    return !std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); });
  };
  const auto first = std::find_if(inverted.begin(), inverted.end(), is_lost);
  if (first == inverted.end()) return {};
  const auto count = std::count_if(first, inverted.end(), is_lost);
  Check c{"invert is finite", Verdict::fail, {}, 0, static_cast<double>(count), 0, Fault::inverse, {}};
  const std::string counts = fmt::format("; {} of {} samples", count, inverted.size());
  c.detail = "invert fails or is not finite" + counts;
  if (!s.describe_draw) return c;
  // Only draws that are points were inverted.
  std::vector<Subject::Draw> draws;
  s.draw(seed, n, draws);
  std::uint64_t index = 0;
  for (auto left = first - inverted.begin(); index < draws.size(); ++index)
    if (draws[index].kind == Subject::Draw::Kind::point && left-- == 0) break;
  if (index < draws.size()) c.detail = "invert fails or is not finite, at " + s.describe_draw(seed, index) + counts;
  return c;
}

std::optional<Check> test_uniformity(const std::vector<Subject::Coordinates>& points, int dim, double error,
                                     double alpha, double share) {
  const double n = static_cast<double>(points.size()), root = std::sqrt(n);
  // The largest effect of the error on a statistic is 6 e sqrt(n) standard deviations.
  if (root * error > 0.05) return {};
  Check c{"inverted samples are uniform", Verdict::pass, 1.0, share, 0, 0, Fault::inverse, {}};
  double family = 0;
  const auto note = [&](double p, double statistic, const std::string& what) {
    family += 1;
    if (p >= *c.p) return;
    c.p = p;
    c.statistic = statistic;
    c.detail = what;
  };
  const auto moment = [&](double sum, double mean, double variance, double slope, const std::string& what) {
    const double z = (sum / n - mean) / std::sqrt(variance / n), bias = slope * error / std::sqrt(variance / n);
    note(normal_tail(std::max(std::abs(z) - bias, 0.0)), z,
         fmt::format("{} of inverted samples is {:.6g}, should be {:.6g}", what, sum / n, mean));
  };
  for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) {
    std::vector<double> values;
    values.reserve(points.size());
    double mean = 0, square = 0;
    for (const auto& u : points) {
      values.push_back(u[a]);
      mean += u[a];
      square += u[a] * u[a];
    }
    const KsTest ks = ks_test(std::move(values), [](double x) { return std::clamp(x, 0.0, 1.0); });
    note(kolmogorov_tail(std::max(ks.d - error, 0.0) * (root + 0.12 + 0.11 / root)), ks.d,
         fmt::format("cumulative distribution of inverted u[{}] differs from uniform by {:.3g} at {:.6g}", a, ks.d,
                     ks.location));
    moment(mean, 1.0 / 2, 1.0 / 12, 1, fmt::format("mean of u[{}]", a));
    moment(square, 1.0 / 3, 4.0 / 45, 2, fmt::format("mean square of u[{}]", a));
    for (std::size_t b = 0; b < a; ++b) {
      double product = 0;
      for (const auto& u : points) product += (u[a] - 0.5) * (u[b] - 0.5);
      moment(product, 0, 1.0 / 144, 1, fmt::format("covariance of u[{}] and u[{}]", b, a));
    }
  }
  c.p = sidak(*c.p, family);
  if (*c.p <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

FitTest uniformity_test(const FitSetup&, double share) {
  return {.judge = [share](const FitCounts& counts) {
    const auto& [s, options, pilot] = counts.setup;
    Findings found;
    if (counts.inverted.empty()) return found;
    if (auto lost = check_inverse_finite(s, inverted_stream(options), inverted_count(options), counts.inverted))
      found.checks.push_back(std::move(*lost));
    else if (auto c = test_uniformity(counts.inverted, s.dim, s.invert_error, options.alpha, share))
      found.checks.push_back(std::move(*c));
    return found;
  }};
}

} // namespace mc
