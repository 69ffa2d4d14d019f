#include <mc/check/fit/weighted_counts.h>

#include <mc/stats/binomial.h>

#include <cmath>

namespace mc {

double CountComparison::z() const { return mean > 0 ? excess / std::sqrt(spread * mean) : 0.0; }

double CountComparison::p() const {
  const double samples = observed / sample_variance;
  if (!(point_variance > 0)) return samples > 0 ? 0.0 : 1.0;
  return binomial_tail(samples, samples + expected / point_variance, point_variance / spread);
}

CountComparison compare(const WeightedCounts& bin, double scale) {
  CountComparison c;
  c.observed = bin.observed;
  c.expected = scale * bin.expected;
  c.excess = c.observed - c.expected;
  const double larger = std::max(c.observed, c.expected);
  if (!(larger > 0)) return c;
  const double variance = sqr(scale) * std::max(bin.expected_squares, bin.shares / scale);
  c.sample_variance = std::max(bin.observed_squares, scale * bin.weights) / larger;
  c.point_variance = variance / larger;
  c.spread = c.sample_variance + c.point_variance;
  c.mean = (c.observed * c.point_variance + c.expected * c.sample_variance) / c.spread;
  return c;
}

} // namespace mc
