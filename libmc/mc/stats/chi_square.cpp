#include <mc/stats/chi_square.h>

#include <mc/core/error.h>
#include <mc/core/types.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>

namespace mc {

double chi_square_tail(double statistic, double dof) {
  if (!(dof > 0) || statistic <= 0) return 1;
  if (!std::isfinite(statistic)) return 0;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(dof), statistic));
}

double chi_square_quantile(double p, double dof) {
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(dof), p));
}

double normal_tail(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double normal_quantile(double p) { return std::sqrt(2.0) * boost::math::erfc_inv(std::clamp(p, 1e-300, 1.0)); }

double chi_square_noncentrality(double dof, double level, double power) {
  const double critical = chi_square_quantile(std::max(level, 1e-300), dof);
  // For many degrees of freedom, noncentral chi-square with noncentrality lambda is about scale times chi-square with h
  // degrees of freedom. The two have equal first and second moments.
  const auto reached = [&](double lambda) {
    if (dof <= 20)
      return boost::math::cdf(boost::math::complement(boost::math::non_central_chi_squared(dof, lambda), critical));
    const double scale = (dof + 2 * lambda) / (dof + lambda), h = sqr(dof + lambda) / (dof + 2 * lambda);
    return chi_square_tail(critical / scale, h);
  };
  double lo = 0, hi = 1;
  while (reached(hi) < power && hi < 1e12) hi *= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (lo + hi);
    (reached(middle) < power ? lo : hi) = middle;
  }
  return hi;
}

ChiSquare chi_square(const std::vector<std::uint64_t>& observed, const std::vector<double>& expected, double alpha,
                     double least) {
  require(observed.size() == expected.size() && !expected.empty(), "chi_square: {} counts for {} expected counts",
          observed.size(), expected.size());
  double total_observed = 0, total_expected = 0;
  bool impossible = false;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    require(expected[i] >= 0 && std::isfinite(expected[i]), "chi_square: expected[{}] = {} is not finite and >= 0", i,
            expected[i]);
    total_observed += static_cast<double>(observed[i]);
    total_expected += expected[i];
    impossible = impossible || (expected[i] == 0 && observed[i] > 0);
  }
  require(total_observed > 0, "chi_square: no samples in {} cells; at least one is needed", observed.size());
  require(std::abs(total_observed - total_expected) <= 1e-6 * total_observed,
          "chi_square: {} observed, {} expected in all: the totals must agree", total_observed, total_expected);

  std::vector<std::pair<double, double>> cells; // observed and expected counts
  double pool_observed = 0, pool_expected = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    pool_observed += static_cast<double>(observed[i]);
    pool_expected += expected[i];
    if (pool_expected >= least) cells.emplace_back(std::exchange(pool_observed, 0), std::exchange(pool_expected, 0));
  }
  if (cells.empty()) cells.emplace_back(0, 0);
  cells.back().first += pool_observed;
  cells.back().second += pool_expected;

  ChiSquare result;
  result.dof = static_cast<double>(cells.size() - 1);
  for (const auto& [o, e] : cells) result.statistic += e > 0 ? sqr(o - e) / e : 0.0;
  if (impossible) {
    result.statistic = HUGE_VAL;
    result.p = 0;
  } else result.p = chi_square_tail(result.statistic, result.dof);
  if (result.dof > 0) result.detectable = std::sqrt(chi_square_noncentrality(result.dof, alpha, 0.99) / total_observed);
  return result;
}

} // namespace mc
