#include <mc/check/fit/weighted_counts.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using mc::compare, mc::Pcg;

int poisson(Pcg& r, double mean) {
  int k = 0;
  for (double t = -std::log1p(-r.uniform<double>()); t < mean; t -= std::log1p(-r.uniform<double>())) ++k;
  return k;
}

TEST(WeightedCounts, Join_AddsSums) {
  mc::WeightedCounts a, b;
  a.add_sample(0.5, 2);
  b.add_sample(1, 3);
  b.add_expected(4, 0.5);
  a.join(b);
  EXPECT_EQ(a.observed, 1.5);
  EXPECT_EQ(a.observed_squares, 1.25);
  EXPECT_EQ(a.shares, 4);
  EXPECT_EQ(a.expected, 4);
  EXPECT_EQ(a.expected_squares, 16);
  EXPECT_EQ(a.weights, 2);
}

TEST(CountComparison, Spread_IncludesBothVariances) {
  mc::WeightedCounts bin;
  for (int i = 0; i < 120; ++i) bin.add_sample(1, 2);
  for (int i = 0; i < 40; ++i) bin.add_expected(2);
  const mc::CountComparison c = compare(bin, 1);
  EXPECT_EQ(c.excess, 40);
  EXPECT_EQ(c.sample_variance, 1);
  EXPECT_NEAR(c.point_variance, 2, 1e-12); // in units of the 120 samples: 240 / 120
  EXPECT_NEAR(c.mean, (120 * 2 + 80) / 3.0, 1e-12);
  EXPECT_NEAR(c.z(), 40 / std::sqrt(3 * c.mean), 1e-12);
}

TEST(CountComparison, BothEmpty_HasPOfOne) {
  const mc::CountComparison c = compare({}, 1);
  EXPECT_EQ(c.z(), 0);
  EXPECT_EQ(c.p(), 1);
}

TEST(CountComparison, SamplesWithoutExpectation_AreRejected) {
  mc::WeightedCounts bin;
  bin.add_sample(1, 0);
  EXPECT_EQ(compare(bin, 1).p(), 0);
}

// Bins of correct samples and random points of very different weights. Half of the mass comes from points that
// represent one sample, half from points that represent 40, of which there is often none. 20000 bins at p <= 1e-3: at
// most 35 with probability 0.999.
TEST(CountComparison, RareHeavyPoints_AreNotRejected) {
  Pcg random(1);
  int rejected = 0, blind = 0;
  for (int run = 0; run < 20'000; ++run) {
    mc::WeightedCounts bin;
    for (const double weight : {1.0, 40.0}) {
      for (int i = poisson(random, 60); i > 0; --i) bin.add_sample(1, weight);
      for (int i = poisson(random, 60 / weight); i > 0; --i) bin.add_expected(weight);
    }
    rejected += compare(bin, 1).p() <= 1e-3;
    // Uses only the random points for the variance.
    bin.shares = 0;
    blind += compare(bin, 1).p() <= 1e-3;
  }
  EXPECT_LE(rejected, 35);
  EXPECT_GE(blind, 200);
}

// Bins with three expected samples of weight 1 and thirty of weight 0.01. One bin in 20 contains only the light
// samples.
TEST(CountComparison, RareHeavySamples_AreNotRejected) {
  Pcg random(2);
  int rejected = 0, blind = 0;
  for (int run = 0; run < 20'000; ++run) {
    mc::WeightedCounts bin;
    for (const auto& [mass, weight] : {std::pair(3.0, 1.0), std::pair(0.3, 0.01)}) {
      for (int i = poisson(random, mass / weight); i > 0; --i) bin.add_sample(weight, 0.1);
      for (int i = poisson(random, mass / 0.1); i > 0; --i) bin.add_expected(0.1, weight);
    }
    rejected += compare(bin, 1).p() <= 1e-3;
    // Uses only the samples for the variance.
    bin.weights = 0;
    blind += compare(bin, 1).p() <= 1e-3;
  }
  EXPECT_LE(rejected, 35);
  EXPECT_GE(blind, 200);
}

TEST(CountComparison, LargeExcess_IsRejected) {
  mc::WeightedCounts spike, gap;
  for (int i = 0; i < 300; ++i) spike.add_sample(1, 2);
  for (int i = 0; i < 50; ++i) {
    spike.add_expected(2);
    gap.add_expected(2);
  }
  EXPECT_LE(compare(spike, 1).p(), 1e-9);
  EXPECT_LE(compare(gap, 1).p(), 1e-8);
}

} // namespace
