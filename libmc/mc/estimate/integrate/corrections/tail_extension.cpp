#include <mc/estimate/integrate/corrections/tail_extension.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

double tail_contribution(const Tail& tail, double count, double cap, const Tuning& t) {
  return t.tail_length * excess_beyond(tail, count * cap, t.tail) / count;
}

double pooled_contribution(std::span<const double> points, std::span<const double> contributions, double shape,
                           const Tuning& t) {
  const std::size_t n = points.size(), pooled = std::min(n, t.pooled_lengths);
  const double rate = 1 - std::clamp(shape, 0.0, t.tail.max_shape);
  double sum = 0;
  for (std::size_t i = n - pooled; i < n; ++i) sum += contributions[i] * std::pow(points[i] / points[n - 1], rate);
  return sum / static_cast<double>(pooled);
}

} // namespace mc::detail
