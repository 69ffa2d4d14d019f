#include <mc/estimate/diagnostics/octave_histogram.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

std::vector<double> powers(std::uint64_t seed, std::size_t n, double p) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::pow(1 - mc::hash_uniform<double>(seed, i), -p);
  return x;
}

TEST(OctaveHistogram, IndexOfAPowerLawWithinItsError) {
  for (const double index : {0.7, 1.0, 2.0, 3.0}) {
    mc::OctaveHistogram m;
    m.add(powers(3, 100'000, 1 / index));
    EXPECT_NEAR(m.tail_index(1000), index, 4 * 1.1 * index / std::sqrt(1000)); // 4 sigma, alpha = 6e-5
  }
}

TEST(OctaveHistogram, MergeEqualsAddingAtAnyScale) {
  const std::vector<double> x = powers(4, 10'000, 0.8);
  for (const int power : {-900, 0, 900}) {
    std::vector<double> scaled(x.size());
    std::transform(x.begin(), x.end(), scaled.begin(), [&](double v) { return -std::ldexp(v, power); });
    mc::OctaveHistogram whole, parts;
    whole.add(scaled);
    for (std::size_t i = 0; i < 10; ++i) {
      mc::OctaveHistogram part;
      part.add(std::span(scaled).subspan((9 - i) * 1000, 1000));
      parts.merge(part);
    }
    parts.merge({});
    EXPECT_EQ(parts.count(), 10'000u);
    EXPECT_EQ(parts.lo(), whole.lo());
    EXPECT_EQ(parts.hi(), whole.hi());
    EXPECT_EQ(parts.tail_index(64), whole.tail_index(64));
    mc::OctaveHistogram plain;
    plain.add(x);
    EXPECT_EQ(whole.tail_index(500), plain.tail_index(500));
  }
}

TEST(OctaveHistogram, UndersampledWhereFewValuesHoldTheSum) {
  const auto undersampled = [](const std::vector<double>& x) {
    mc::OctaveHistogram m;
    m.add(x);
    return m.undersampled();
  };
  EXPECT_FALSE(undersampled({}));
  EXPECT_FALSE(undersampled({0, 0, 0}));
  EXPECT_FALSE(undersampled({7}));
  EXPECT_FALSE(undersampled({0, 0, 1, 1, 0})); // a step with two points beyond it
  EXPECT_FALSE(undersampled(std::vector<double>(1000, -3)));
  EXPECT_TRUE(undersampled({1, 1e-5, 1e-9, 0, 0}));
  EXPECT_TRUE(undersampled({1, 1e-80, 1e-200}));                     // all but one below the lowest octave
  EXPECT_TRUE(undersampled({1e-308, 1e-313, 1e-317, 5e-324, 0, 0})); // subnormal
  std::vector<double> one(1000);
  one.front() = -2;
  EXPECT_TRUE(undersampled(one)); // further nonzero values may have any size
  one.back() = -2;
  EXPECT_FALSE(undersampled(one));
  for (const auto& [index, few] : {std::pair{0.2, true}, {2.0, false}}) // 16 values determine the index to a quarter
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
      EXPECT_EQ(undersampled(powers(seed, 5000, 1 / index)), few) << index << " seed " << seed;
}

TEST(OctaveHistogram, MeanMagnitudeIsWithinAFactorOfTwo) {
  EXPECT_EQ(mc::OctaveHistogram().mean_magnitude(), 0);
  for (const double scale : {1e-300, 1.0, 1e300}) {
    mc::OctaveHistogram m;
    m.add(std::vector<double>{-4 * scale, 3 * scale, 0, 0, scale});
    EXPECT_LE(m.mean_magnitude(), 1.6 * scale);
    EXPECT_GE(m.mean_magnitude(), 0.8 * scale);
  }
}

// The part of the mean above the largest value of a power law with index a is a / (a - 1) max^(1 - a). Sixteen values
// determine the index to about a quarter. The test compares medians, with the factor that this gives for an index of
// 1.5.
TEST(OctaveHistogram, ExtrapolatedTailMeanOfAPowerLaw) {
  mc::OctaveHistogram none, equal;
  equal.add(std::vector<double>{0, 3, -3, 3});
  EXPECT_EQ(none.extrapolated_tail_mean(), 0);
  EXPECT_EQ(equal.extrapolated_tail_mean(), 0); // like values of a step
  for (const double index : {1.5, 2.0, 4.0}) {
    std::vector<double> ratio;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const std::vector<double> x = powers(seed, 5000, 1 / index);
      mc::OctaveHistogram m;
      m.add(x);
      ratio.push_back(m.extrapolated_tail_mean() / (index / (index - 1) * std::pow(m.hi(), 1 - index)));
      ASSERT_LE(m.extrapolated_tail_mean(), 11 * m.hi() / 5000 * (1 + 1e-12));
    }
    std::nth_element(ratio.begin(), ratio.begin() + 100, ratio.end());
    EXPECT_GT(ratio[100], 0.7) << index;
    EXPECT_LT(ratio[100], 2.5) << index;
  }
}

TEST(OctaveHistogram, BoundedValuesHaveNoTail) {
  mc::OctaveHistogram zeros, ones, uniform;
  zeros.add(std::vector<double>(1000, 0.0));
  ones.add(std::vector<double>(1000, 1.0));
  for (std::size_t i = 0; i < 1000; ++i) uniform.add(std::vector{mc::hash_uniform<double>(5, i)});
  for (const mc::OctaveHistogram& m : {zeros, ones, uniform}) {
    EXPECT_EQ(m.tail_index(64), std::numeric_limits<double>::infinity());
  }
  mc::OctaveHistogram bad;
  bad.add(std::vector{std::nan(""), std::numeric_limits<double>::infinity()});
  EXPECT_EQ(bad.count(), 0u);
}

} // namespace
