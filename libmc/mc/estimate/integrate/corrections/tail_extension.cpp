#include <mc/estimate/integrate/corrections/tail_extension.h>

namespace mc::detail {

double tail_contribution(const TailFit& tail, double count, double cap, const Tuning& t) {
  if (!(tail.largest_excess > 0)) return 0;
  const double shape = std::clamp(upper_shape(tail, t.tail), 0.0, t.max_shape);
  return t.tail_length * std::min(tail.largest_excess / count, cap) * (shape / (1 - shape));
}

double pooled_contribution(std::span<const double> points, std::span<const double> contributions, double shape,
                           const Tuning& t) {
  const std::size_t n = points.size(), pooled = std::min(n, t.pooled_lengths);
  const double rate = 1 - std::clamp(shape, 0.0, t.max_shape);
  double sum = 0;
  for (std::size_t i = n - pooled; i < n; ++i) sum += contributions[i] * std::pow(points[i] / points[n - 1], rate);
  return sum / static_cast<double>(pooled);
}

} // namespace mc::detail
