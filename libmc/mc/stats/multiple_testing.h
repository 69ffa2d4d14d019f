#pragma once
/// Control of the family-wise error rate of many tests.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace mc {

/// Adjusted p-value of the smallest of m independent p-values: 1 - (1 - p)^m, accurate also for tiny p.
///   Source : [Sidak67]. Conservative for two-sided normal statistics of any correlation.
inline double sidak(double p, double m) { return p >= 1 ? 1.0 : std::clamp(-std::expm1(m * std::log1p(-p)), 0.0, 1.0); }

/// Adjusted p-value of a test with a share of the family-wise alpha. The test rejects if the result is at most alpha.
/// The shares of a family add up to 1. Equal shares give sidak(p, m).
inline double sidak_share(double p, double share) { return share > 0 ? sidak(p, 1 / share) : 1.0; }

/// Level at which a test with this share of alpha rejects: sidak_share(level, share) = alpha.
inline double sidak_level(double alpha, double share) { return -std::expm1(share * std::log1p(-alpha)); }

/// Adjusted p-values by Holm's step-down method. Reject the tests with an adjusted value of at most alpha. Valid for
/// any dependence between the tests.
///   Source : [Holm79].
inline std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double running = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    running = std::max(running, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
    adjusted[order[i]] = running;
  }
  return adjusted;
}

} // namespace mc
