#include <mc/core/types.h>
#include <mc/estimate/integrate/corrections/pooled_variance.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

std::optional<double> convergence_rate(std::span<const double> points, std::span<const double> spreads,
                                       const Tuning& t) {
  const std::size_t n = points.size();
  double count = 0, x = 0, y = 0, xx = 0, xy = 0;
  double size = 0; // a power of two in every spread must not change the result
  for (const double s : spreads) size = std::max(size, s);
  const int exponent = size > 0 ? std::ilogb(size) : 0;
  for (std::size_t i = n - std::min(n, t.rate_lengths); i < n; ++i) {
    if (!(spreads[i] > 0)) continue;
    const double a = std::log2(points[i]), b = std::log2(std::ldexp(spreads[i], -exponent));
    count += 1;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  const double variance = count * xx - x * x;
  if (count < 3 || !(variance > 0)) return {};
  return std::clamp(-(count * xy - x * y) / variance, 0.0, t.max_rate);
}

double pooled_spread(std::span<const double> points, std::span<const double> spreads, const Tuning& t) {
  const double rate = convergence_rate(points, spreads, t).value_or(unknown_rate);
  // Two lengths do not tell a rate, so that the present one counts alone.
  const std::size_t n = points.size(), pooled = n < 3 ? 1 : std::min(n, t.pooled_lengths);
  double largest = 0; // so that no square overflows or underflows
  for (std::size_t i = n - pooled; i < n; ++i) largest = std::max(largest, spreads[i]);
  if (!(largest > 0)) return 0;
  double sum = 0;
  for (std::size_t i = n - pooled; i < n; ++i)
    sum += sqr(spreads[i] / largest * std::pow(points[i] / points[n - 1], rate));
  return std::max(largest * std::sqrt(sum / static_cast<double>(pooled)), spreads.back());
}

} // namespace mc::detail
