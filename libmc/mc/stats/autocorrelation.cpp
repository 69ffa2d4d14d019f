#include <mc/stats/autocorrelation.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace mc {
namespace {

double mean_of(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

// The mean of (x_i - mean) (x_(i+lag) - mean), with all n in the denominator.
double covariance(std::span<const double> x, double mean, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) sum += (x[i] - mean) * (x[i + lag] - mean);
  return sum / static_cast<double>(x.size());
}

} // namespace

double autocorrelation_time(std::span<const double> sequence) {
  constexpr std::size_t most_lags = 64, fewest = 4 * most_lags;
  constexpr double window = 5;
  const auto n = static_cast<double>(sequence.size());
  if (sequence.size() < 2) return 1;
  const double mean = mean_of(sequence), variance = covariance(sequence, mean, 0);
  if (!(variance > 0)) return n;
  std::vector<double> x(sequence.begin(), sequence.end());
  for (double block = 1;; block *= 2) {
    const double own = covariance(x, mean, 0);
    double time = 1; // in blocks
    bool is_long = true;
    for (std::size_t lag = 1; lag < std::min(most_lags, x.size()) && is_long; ++lag) {
      time += 2 * covariance(x, mean, lag) / own;
      is_long = static_cast<double>(lag) < window * time;
    }
    if (!is_long || x.size() < fewest || !(own > 0)) return std::clamp(time * block * own / variance, 1.0, n);
    for (std::size_t i = 0; i + 1 < x.size(); i += 2) x[i / 2] = 0.5 * (x[i] + x[i + 1]);
    x.resize(x.size() / 2);
  }
}

std::size_t thinning_distance(double time, std::size_t n) {
  constexpr double below_noise = 0.1, for_slow_modes = 2;
  if (!(time > 1)) return 1;
  const double fall = std::log((time + 1) / (time - 1));
  const double steps = std::log(std::sqrt(static_cast<double>(n)) / below_noise) / fall;
  return static_cast<std::size_t>(std::clamp(std::ceil(for_slow_modes * steps), 1.0, static_cast<double>(n)));
}

} // namespace mc
