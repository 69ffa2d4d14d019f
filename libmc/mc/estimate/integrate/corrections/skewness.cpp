#include <mc/core/types.h>
#include <mc/estimate/integrate/corrections/skewness.h>
#include <mc/stats/scale.h>

#include <cmath>
#include <limits>

namespace mc::detail {

double skew_of_mean(std::span<const double> numbers, const Tuning& t) {
  const double count = static_cast<double>(numbers.size());
  const double largest = largest_size(numbers);
  if (!(largest > 0) || numbers.size() < 3) return 0;
  double mean = 0, second = 0, third = 0;
  for (const double x : numbers) mean += x / largest / count;
  for (const double x : numbers) second += sqr(x / largest - mean) / (count - 1);
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  if (second < sqr(rounding)) return 0;
  for (const double x : numbers) third += std::pow(x / largest - mean, 3) / count;
  const double unbiased = count * count / ((count - 1) * (count - 2));
  return t.skewness * third * unbiased / std::pow(second, 1.5) / (6 * std::sqrt(count));
}

} // namespace mc::detail
