#include <mc/estimate/integrate/correlation.h>
#include <mc/stats/scale.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc::detail {

namespace {
// Deviations from the mean as a unit vector; zeros if they are only rounding errors.
std::vector<double> direction(std::vector<double> x) {
  const int exponent = largest_exponent(x);
  for (double& v : x) v = std::ldexp(v, -exponent);
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  double square = 0;
  for (double& v : x) {
    v -= mean;
    square += v * v;
  }
  constexpr double rounding = 1e-15;
  for (double& v : x) v = square > rounding * rounding * static_cast<double>(x.size()) ? v / std::sqrt(square) : 0;
  return x;
}
} // namespace

Correlations correlations(const std::vector<std::vector<double>>& means) {
  const std::size_t n = means.size();
  std::vector<std::vector<double>> directions(n);
  std::transform(means.begin(), means.end(), directions.begin(), direction);
  Correlations all(n * n, 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double c = std::inner_product(directions[i].begin(), directions[i].end(), directions[j].begin(), 0.0);
      all[i * n + j] = all[j * n + i] = std::clamp(c, -1.0, 1.0);
    }
  return all;
}

Correlations combine_independent(const Correlations& of_a, const Means& a, const Correlations& of_b, const Means& b,
                                 double share) {
  const std::size_t n = a.size();
  // Share of each mean in the combined error.
  std::vector<double> from_a(n), from_b(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double error = std::hypot((1 - share) * a[i].error, share * b[i].error);
    if (!(error > 0)) continue;
    from_a[i] = (1 - share) * a[i].error / error;
    from_b[i] = share * b[i].error / error;
  }
  Correlations all(n * n, 1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) all[i * n + j] = from_a[i] * from_a[j] * of_a[i * n + j] + from_b[i] * from_b[j] * of_b[i * n + j];
  return all;
}

} // namespace mc::detail
