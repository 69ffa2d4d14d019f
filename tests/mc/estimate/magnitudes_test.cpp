#include <mc/estimate/magnitudes.h>
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

TEST(Magnitudes, IndexOfAPowerLawWithinItsError) {
  for (const double index : {0.7, 1.0, 2.0, 3.0}) {
    mc::Magnitudes m;
    m.add(powers(3, 100'000, 1 / index));
    EXPECT_NEAR(m.tail_index(1000), index, 4 * 1.1 * index / std::sqrt(1000)); // 4 sigma, alpha = 6e-5
  }
}

TEST(Magnitudes, MergedAsAddedAndOfAnySize) {
  const std::vector<double> x = powers(4, 10'000, 0.8);
  for (const int power : {-900, 0, 900}) {
    std::vector<double> scaled(x.size());
    std::transform(x.begin(), x.end(), scaled.begin(), [&](double v) { return -std::ldexp(v, power); });
    mc::Magnitudes whole, parts;
    whole.add(scaled);
    for (std::size_t i = 0; i < 10; ++i) {
      mc::Magnitudes part;
      part.add(std::span(scaled).subspan((9 - i) * 1000, 1000));
      parts.merge(part);
    }
    parts.merge({});
    EXPECT_EQ(parts.count(), 10'000u);
    EXPECT_EQ(parts.lo(), whole.lo());
    EXPECT_EQ(parts.hi(), whole.hi());
    EXPECT_EQ(parts.tail_index(64), whole.tail_index(64));
    mc::Magnitudes plain;
    plain.add(x);
    EXPECT_EQ(whole.tail_index(500), plain.tail_index(500));
  }
}

TEST(Magnitudes, BoundedValuesHaveNoTail) {
  mc::Magnitudes zeros, ones, uniform;
  zeros.add(std::vector<double>(1000, 0.0));
  ones.add(std::vector<double>(1000, 1.0));
  for (std::size_t i = 0; i < 1000; ++i) uniform.add(std::vector{mc::hash_uniform<double>(5, i)});
  for (const mc::Magnitudes& m : {zeros, ones, uniform}) {
    EXPECT_EQ(m.tail_index(64), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(m.infinite_variance());
  }
  mc::Magnitudes bad;
  bad.add(std::vector{std::nan(""), std::numeric_limits<double>::infinity()});
  EXPECT_EQ(bad.count(), 0u);
}

// Of 200 samples of 30'000 each: x^-1/2 and x^-0.9 are named, x^-0.3 and a narrow Gaussian peak in five dimensions are
// not. The bounds are .9, .9,
// .05 and .05 of them; the seeds are fixed.
TEST(Magnitudes, InfiniteVarianceIsNamed) {
  int named[4] = {};
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto count = [&](int row, const std::vector<double>& x) {
      mc::Magnitudes m;
      m.add(x);
      named[row] += m.infinite_variance();
    };
    count(0, powers(10 + seed, 30'000, 0.5));
    count(1, powers(10 + seed, 30'000, 0.9));
    count(2, powers(10 + seed, 30'000, 0.3));
    std::vector<double> peak(30'000);
    for (std::size_t i = 0; i < peak.size(); ++i) {
      double r2 = 0;
      for (int d = 0; d < 5; ++d) r2 += std::pow(mc::hash_uniform<double>(seed, i, d) - 0.5, 2);
      peak[i] = std::exp(-r2 / (2 * 0.1 * 0.1));
    }
    count(3, peak);
  }
  EXPECT_GE(named[0], 180);
  EXPECT_GE(named[1], 180);
  EXPECT_LE(named[2], 10);
  EXPECT_LE(named[3], 10);
}

} // namespace
