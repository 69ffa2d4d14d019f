#pragma once
/// Counts of samples in a bin, compared with random points that estimate the expected count.

#include <mc/core/types.h>

#include <algorithm>

namespace mc {

/// Sums of the weights of the samples and of the random points in one bin. A random point may represent many more
/// samples than another. If such points are rare, a bin may contain none by chance, and the points alone would
/// underestimate the variance. Each sample therefore adds the share that a random point at its position would have. For
/// the same reason, each random point adds the weight that a sample at its position would have.
struct WeightedCounts {
  double observed = 0, observed_squares = 0;
  double expected = 0, expected_squares = 0;
  double shares = 0;  ///< sum over samples of the weight times the share of a random point there
  double weights = 0; ///< sum over random points of the share times the weight of a sample there

  void add_sample(double weight, double share) {
    observed += weight;
    observed_squares += weight * weight;
    shares += weight * share;
  }
  void add_expected(double share, double weight = 1) {
    expected += share;
    expected_squares += share * share;
    weights += share * weight;
  }
  void join(const WeightedCounts& other) {
    observed += other.observed;
    observed_squares += other.observed_squares;
    expected += other.expected;
    expected_squares += other.expected_squares;
    shares += other.shares;
    weights += other.weights;
  }
};

/// Two estimates of the same count, each with its variance.
struct CountComparison {
  double excess = 0;                              ///< observed - expected, in samples
  double mean = 0;                                ///< mean of observed and expected, weighted by precision
  double spread = 1;                              ///< variance of the excess is spread * mean
  double sample_variance = 1, point_variance = 1; ///< contributions to spread; their sum
  double observed = 0, expected = 0;              ///< counts, in samples
  /// Returns the excess in standard deviations.
  double z() const;
  /// Returns the effective number of samples in the comparison. The excess is nearly normal if this number is large.
  double information() const { return mean / spread; }
  /// Returns the two-sided p-value. Given the sum of both counts, the number of samples is binomial.
  ///   Source : [PrzyborowskiWilenski40].
  double p() const;
};
/// Compares the counts of a bin.
///   scale : number of samples per unit of expectation.
CountComparison compare(const WeightedCounts& bin, double scale);

} // namespace mc
