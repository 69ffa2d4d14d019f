#include <mc/stats/ks_test.h>

#include <mc/core/error.h>
#include <mc/stats/sort_numbers.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mc {

double kolmogorov_tail(double lambda) {
  if (!(lambda > 0)) return 1;
  if (lambda < 1) {
    // This expansion of the theta function converges fast for small lambda, where the alternating series cancels.
    double sum = 0;
    for (int k = 1; k < 20; k += 2)
      sum += std::exp(-k * k * std::numbers::pi * std::numbers::pi / (8 * lambda * lambda));
    return 1 - std::sqrt(2 * std::numbers::pi) / lambda * sum;
  }
  double sum = 0;
  for (int k = 1; k < 20; ++k) sum += (k % 2 ? 1 : -1) * std::exp(-2.0 * k * k * lambda * lambda);
  return std::clamp(2 * sum, 0.0, 1.0);
}

KsTest ks_test(std::vector<double> samples, const std::function<double(double)>& cdf) {
  require(!samples.empty(), "ks_test: no samples");
  for (std::size_t i = 0; i < samples.size(); ++i)
    require(std::isfinite(samples[i]), "ks_test: samples[{}] = {} is not finite", i, samples[i]);
  sort_numbers(samples);
  KsTest result;
  const double n = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double f = cdf(samples[i]);
    const double d = std::max(static_cast<double>(i + 1) / n - f, f - static_cast<double>(i) / n);
    if (d > result.d) {
      result.d = d;
      result.location = samples[i];
    }
  }
  result.p = kolmogorov_tail(result.d * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)));
  return result;
}

} // namespace mc
