#include <mc/estimate/integrate/corrections/pooled_variance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using mc::detail::convergence_rate;
using mc::detail::pooled_spread;

const std::vector<double> lengths = {64, 128, 256, 512, 1024, 2048, 4096};

std::vector<double> falling(double rate) {
  std::vector<double> spreads;
  for (const double n : lengths) spreads.push_back(3 * std::pow(n, -rate));
  return spreads;
}

TEST(PooledVariance, PowerLawIsReproduced) {
  for (const double rate : {0.0, 0.5, 1.5, 2.5}) {
    EXPECT_NEAR(*convergence_rate(lengths, falling(rate)), rate, 1e-12);
    EXPECT_NEAR(pooled_spread(lengths, falling(rate)), falling(rate).back(), 1e-12 * falling(rate).back());
  }
  for (const double scale : {1e-300, 1e300}) {
    std::vector<double> spreads = falling(1);
    for (double& s : spreads) s *= scale;
    EXPECT_NEAR(pooled_spread(lengths, spreads) / spreads.back(), 1, 1e-9);
  }
}

// Interlaced points reach 2.5; a fitted rate may exceed that by 1.
TEST(PooledVariance, RateIsClippedAndNeedsThreeLengths) {
  EXPECT_EQ(convergence_rate(lengths, falling(9)), 3.5);
  std::vector<double> rising = falling(0.5);
  std::reverse(rising.begin(), rising.end());
  EXPECT_EQ(convergence_rate(lengths, rising), 0);
  EXPECT_FALSE(convergence_rate(std::vector<double>{64, 128}, std::vector<double>{1, 0.5}));
  EXPECT_FALSE(convergence_rate(lengths, std::vector<double>{1, 0, 0, 0.5, 0, 0, 0.25})); // only two of the last six
}

// Replicates that agree by chance at the last length must not make the error vanish.
TEST(PooledVariance, AgreementByChance_KeepsEarlierSpreads) {
  std::vector<double> spreads = falling(1);
  const double expected = spreads.back();
  spreads.back() = 0;
  EXPECT_NEAR(pooled_spread(lengths, spreads), std::sqrt(3.0 / 4) * expected, 1e-9 * expected);
  EXPECT_EQ(pooled_spread(lengths, std::vector<double>(lengths.size(), 0.0)), 0);
}

// Where the spread falls in steps, the present one may lie above the line through the others.
TEST(PooledVariance, IsAtLeastThePresentSpread) {
  std::vector<double> spreads = falling(1.5);
  spreads.back() = spreads[spreads.size() - 2];
  EXPECT_EQ(pooled_spread(lengths, spreads), spreads.back());
}

// Six lengths tell the rate. Earlier ones, at which the points do not yet resolve the integrand, do not matter.
TEST(PooledVariance, EarlyLengthsDoNotTellTheRate) {
  std::vector<double> spreads = falling(1.5);
  spreads[0] *= 1e3;
  EXPECT_NEAR(*convergence_rate(lengths, spreads), 1.5, 1e-12);
  spreads[1] *= 2;
  EXPECT_GT(convergence_rate(lengths, spreads), 1.6);
}

// Without pooling the last spread counts alone.
TEST(PooledVariance, PooledLengthsAreThoseOfTheTuning) {
  std::vector<double> spreads = falling(0.5);
  spreads.back() *= 0.1;
  mc::detail::Tuning alone;
  alone.pooled_lengths = 1;
  EXPECT_DOUBLE_EQ(pooled_spread(lengths, spreads, alone), spreads.back());
  EXPECT_GT(pooled_spread(lengths, spreads), 3 * spreads.back());
}

} // namespace
