#include <mc/estimate/diagnostics/tail.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mc {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();

// Shape by probability-weighted moments [HoskingWallis87]. Cheap, and too small where it exceeds 1/2.
double shape_by_moments(std::span<const double> excesses) {
  const auto k = static_cast<double>(excesses.size());
  // The i-th largest of k is exceeded with probability (i - .35) / k.
  double b0 = 0, b1 = 0;
  for (std::size_t i = 0; i < excesses.size(); ++i) {
    b0 += excesses[i];
    b1 += excesses[i] * ((static_cast<double>(i) + 0.65) / k);
  }
  const double spread = b0 - 2 * b1;
  return spread > 1e-12 * b0 ? 2 - b0 / spread : -infinity;
}

// Mean of log(1 + theta x): the shape of largest likelihood for theta = shape / scale.
double shape_for(double theta, std::span<const double> excesses) {
  double sum = 0;
  for (const double x : excesses) sum += std::log1p(theta * x);
  return sum / static_cast<double>(excesses.size());
}

// Posterior mean of theta under the prior of [ZhangStephens09], and the shape that belongs to it.
double shape_by_likelihood(std::span<const double> excesses) {
  const std::size_t k = excesses.size();
  const double largest = excesses.front(), quartile = excesses[k - 1 - (k / 4 > 0 ? (k + 2) / 4 - 1 : 0)];
  const auto count = static_cast<double>(k), nodes = 20 + std::floor(std::sqrt(count));
  std::vector<double> thetas, log_likelihoods;
  for (std::size_t i = 0; i < static_cast<std::size_t>(nodes); ++i) {
    const double j = static_cast<double>(i) + 0.5;
    const double theta = (std::sqrt(nodes / j) - 1) / (3 * std::max(quartile, 1e-3 * largest)) - 1 / largest;
    const double shape = shape_for(theta, excesses), log_likelihood = count * (std::log(theta / shape) - shape - 1);
    if (!std::isfinite(log_likelihood)) continue;
    thetas.push_back(theta);
    log_likelihoods.push_back(log_likelihood);
  }
  if (thetas.empty()) return 0;
  const double best = *std::max_element(log_likelihoods.begin(), log_likelihoods.end());
  double weight = 0, sum = 0;
  for (std::size_t i = 0; i < thetas.size(); ++i) {
    const double w = std::exp(log_likelihoods[i] - best);
    weight += w;
    sum += w * thetas[i];
  }
  return shape_for(sum / weight, excesses);
}
} // namespace

TailFit fit_tail(std::span<const double> descending) {
  if (descending.size() < 6) return {};
  const std::size_t k = descending.size() - 1;
  const double threshold = descending[k], largest = descending[0] - threshold;
  if (!std::isfinite(largest)) return {};
  if (!(largest > 0)) return {-infinity, 0, k}; // an upper bound that many values reach
  std::vector<double> excesses(k);              // in units of the largest
  for (std::size_t i = 0; i < k; ++i) excesses[i] = (descending[i] - threshold) / largest;
  const double shape = shape_by_moments(excesses);
  return {shape > 0 ? shape_by_likelihood(excesses) : shape, largest, k};
}

double upper_shape(const TailFit& fit, const TailOptions& o) {
  return fit.shape + o.shape_deviation / std::sqrt(static_cast<double>(std::max<std::size_t>(fit.values, 1)));
}

Tail find_tail(std::span<const double> descending, std::size_t count, const TailOptions& o) {
  const std::size_t most = std::clamp(static_cast<std::size_t>(o.share * static_cast<double>(count)), o.least, o.most);
  const auto fit = [&](std::size_t k) { return fit_tail(descending.first(std::min(k + 1, descending.size()))); };
  Tail tail{fit(most), {}, 0};
  const double top = upper_shape(fit(o.least), o);
  tail.shape = std::min(tail.fit.shape, top);
  if (most / 4 < o.least) return tail;
  tail.deep = fit(most / 4);
  // The bulk may reach beyond the lowest threshold: then the values above a higher one are the tail.
  const double above = 2 * tail.deep.shape - upper_shape(tail.deep, o);
  tail.shape = std::max(std::min(tail.shape, upper_shape(tail.deep, o)), std::min(above, top));
  return tail;
}

Tail find_tail(const Extremes& e, TailSide side, const TailOptions& o) {
  std::vector<double> values = side == TailSide::largest ? e.largest(o.most + 1) : e.smallest(o.most + 1);
  if (side == TailSide::smallest)
    for (double& x : values) x = -x;
  return find_tail(values, e.count(), o);
}

double excess_beyond(const Tail& tail, double cap, const TailOptions& o) {
  const auto beyond = [&](const TailFit& fit) {
    const double shape = std::clamp(upper_shape(fit, o), 0.0, o.max_shape);
    return fit.largest_excess > 0 ? std::min(fit.largest_excess, cap) * (shape / (1 - shape)) : 0.0;
  };
  return std::max(beyond(tail.fit), beyond(tail.deep));
}

} // namespace mc
