#include <mc/estimate/integrate/corrections/tail_extension.h>

namespace mc::detail {

double tail_contribution(const TailFit& tail, double count, double cap, const Tuning& t) {
  if (!(tail.largest_excess > 0)) return 0;
  const double shape = std::clamp(upper_shape(tail, t.tail), 0.0, t.max_shape);
  return t.tail_length * std::min(tail.largest_excess / count, cap) * (shape / (1 - shape));
}

} // namespace mc::detail
