#pragma once
/// Samples in a bin against random points that say how many belong there.

#include <mc/core/types.h>

#include <algorithm>

namespace mc {

/// Sums of the weights of both in one bin. One random point may stand for far more samples than another. Where those
/// that stand for many are rare, none may have met the bin; so each sample also says what a point at its place would
/// stand for. Likewise, where most samples of the bin weigh little, none of full weight may have met it; so each point
/// also says what a sample at its place would weigh.
struct WeightedCounts {
  double observed = 0, observed_squares = 0;
  double expected = 0, expected_squares = 0;
  double shares = 0;  ///< of the samples: weight times the share that a random point at its place has
  double weights = 0; ///< of the random points: share times the weight that a sample at its place has

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

/// Both as counts of the same bin: that many samples, each with its variance, were expected.
struct CountComparison {
  double excess = 0;                              ///< observed - expected, in samples
  double mean = 0;                                ///< of what both say, each by its precision
  double spread = 1;                              ///< variance of the excess is spread times mean
  double sample_variance = 1, point_variance = 1; ///< spread is their sum
  double observed = 0, expected = 0;
  double z() const;
  /// How many samples the comparison is worth: the excess is nearly normal where this is large.
  double information() const { return mean / spread; }
  /// Two-sided: given both counts together, the samples among them are binomial.
  ///   Source : [PrzyborowskiWilenski40]
  double p() const;
};
/// scale : samples for each unit of expectation
CountComparison compare(const WeightedCounts& bin, double scale);

} // namespace mc
