#include "point_lists.h"

#include <mc/points/discrepancy.h>
#include <mc/random/hash.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using mc::PointList;
using test::scattered;

struct Expected {
  std::size_t n, dim;
  double l2_star, wraparound_square, centered_square;
};

// scipy.stats.qmc.discrepancy of SciPy 1.10.1 for scattered(n, dim), methods L2-star (root), WD and CD (squares).
constexpr Expected of_scipy[] = {
    {1, 1, 0.57480750789027713, 0.16666666666666674, 0.33040367112703106},
    {2, 1, 0.5728986818442765, 0.16520183556351564, 0.32821289965890954},
    {16, 2, 0.29168408053696304, 0.20769729053852481, 0.33395987641791813},
    {100, 2, 0.2307700250972182, 0.11107178136252926, 0.17909861222227463},
    {64, 3, 0.13823745453585393, 0.21043560296322417, 0.2709492807870002},
    {257, 5, 0.016870801140725949, 0.036260508192508034, 0.029891796481128052},
    {50, 8, 0.0093378315728581598, 1.3357034762701403, 0.61851581892577912},
};

TEST(Discrepancy, AgreesWithScipy) {
  for (const Expected& e : of_scipy) {
    const std::vector<double> x = scattered(e.n, e.dim);
    const PointList p{x, e.dim};
    EXPECT_NEAR(mc::l2_star_discrepancy(p), e.l2_star, 1e-12) << e.n << " " << e.dim;
    EXPECT_NEAR(std::pow(mc::wraparound_discrepancy(p), 2), e.wraparound_square, 1e-12);
    EXPECT_NEAR(std::pow(mc::centered_discrepancy(p), 2), e.centered_square, 1e-12);
  }
}

// Exact fractions of the square, within the documented error bound.
TEST(Discrepancy, MatchesKnownValues) {
  const auto expect = [](double root, double square) { EXPECT_NEAR(root * root, square, 1e-13 / 9); };
  const std::vector<double> middle = {0.5, 0.5}, four = {.25, .25, .25, .75, .75, .25, .75, .75};
  expect(mc::l2_star_discrepancy({middle, 2}), 23.0 / 288);
  expect(mc::l2_star_discrepancy({four, 2}), 71.0 / 4608);
  expect(mc::centered_discrepancy({middle, 2}), 25.0 / 144);
  expect(mc::wraparound_discrepancy({middle, 2}), 17.0 / 36);
  const std::vector<double> many(3000, 0.5); // one point, whose squares overflow
  EXPECT_EQ(mc::wraparound_discrepancy({many, 3000}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(mc::mixture_discrepancy({many, 3000}), std::numeric_limits<double>::infinity());
  expect(mc::mixture_discrepancy({middle, 2}), 269.0 / 576);
  expect(mc::centered_discrepancy({four, 2}), 215.0 / 4608);
  expect(mc::wraparound_discrepancy({four, 2}), 65.0 / 576);
  expect(mc::mixture_discrepancy({four, 2}), 1855.0 / 18432);
  const std::vector<double> net = test::hammersley(0), shifted = test::hammersley(1.0 / 16);
  expect(mc::l2_star_discrepancy({net, 2}), 4499.0 / 294912);
  expect(mc::centered_discrepancy({net, 2}), 4499.0 / 294912);
  expect(mc::wraparound_discrepancy({net, 2}), 1457.0 / 147456);
  expect(mc::mixture_discrepancy({net, 2}), 17749.0 / 1179648);
  expect(mc::l2_star_discrepancy({shifted, 2}), 5567.0 / 1179648);
  expect(mc::centered_discrepancy({shifted, 2}), 7871.0 / 1179648);
  expect(mc::wraparound_discrepancy({shifted, 2}), 1457.0 / 147456);
  // One point: the share in a box is 1 with probability 1/2 on each axis, so E (1_B - V)^2 = 2^-d - 3^-d.
  expect(mc::periodic_l2_discrepancy({middle, 2}), 1.0 / 4 - 1.0 / 9);
}

TEST(Discrepancy, OnePassGivesTheSameBits) {
  for (const std::size_t dim : {1, 2, 5}) {
    const std::vector<double> x = scattered(101, dim);
    const PointList p{x, dim};
    const mc::L2Discrepancies all = mc::l2_discrepancies(p);
    EXPECT_EQ(all.star, mc::l2_star_discrepancy(p));
    EXPECT_EQ(all.periodic, mc::periodic_l2_discrepancy(p));
    EXPECT_EQ(all.centered, mc::centered_discrepancy(p));
    EXPECT_EQ(all.wraparound, mc::wraparound_discrepancy(p));
    EXPECT_EQ(all.mixture, mc::mixture_discrepancy(p));
  }
}

// Compares with the definition, the mean over 2e5 random boxes with uniform corners and lengths. The bound of 2 % is at
// least five standard errors.
TEST(Discrepancy, PeriodicIsTheMeanOverBoxesThatWrap) {
  const std::vector<double> x = scattered(40, 2);
  const PointList p{x, 2};
  const mc::Independent random{5};
  double sum = 0;
  constexpr std::uint64_t boxes = 200'000;
  for (std::uint64_t b = 0; b < boxes; ++b) {
    double inside = 0, volume = 1;
    std::array<double, 2> start{}, length{};
    for (std::uint32_t k = 0; k < 2; ++k) {
      start[k] = mc::coordinate<double>(random, b, 2 * k);
      length[k] = mc::coordinate<double>(random, b, 2 * k + 1);
      volume *= length[k];
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
      bool in = true;
      for (std::size_t k = 0; k < 2; ++k) {
        const double t = p[i][k] - start[k];
        in = in && (t < 0 ? t + 1 : t) < length[k];
      }
      inside += in;
    }
    const double off = inside / static_cast<double>(p.size()) - volume;
    sum += off * off;
  }
  const double square = std::pow(mc::periodic_l2_discrepancy(p), 2);
  EXPECT_NEAR(sum / boxes, square, 0.02 * square);
}

TEST(Discrepancy, PeriodicOnesAreShiftInvariant) {
  const std::vector<double> x = test::points_of(mc::Sobol(3), 64, 3);
  std::vector<double> moved = x;
  for (double& v : moved) v = v + 0.375 < 1 ? v + 0.375 : v + 0.375 - 1;
  EXPECT_NEAR(mc::periodic_l2_discrepancy({x, 3}), mc::periodic_l2_discrepancy({moved, 3}), 1e-13);
  EXPECT_NEAR(mc::wraparound_discrepancy({x, 3}), mc::wraparound_discrepancy({moved, 3}), 1e-13);
  EXPECT_NEAR(mc::smallest_distance({x, 3}).periodic, mc::smallest_distance({moved, 3}).periodic, 1e-13);
}

// Compares means of 400 sets with the formulas, within five standard errors.
TEST(Discrepancy, ExpectationsOfRandomAndJitteredPoints) {
  struct Mean {
    double sum = 0, squares = 0;
    void add(double x) {
      sum += x;
      squares += x * x;
    }
    void expect(double truth, const char* what) const {
      const double n = 400, mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
      EXPECT_NEAR(mean, truth, 5 * error) << what;
    }
  };
  Mean star, periodic, centered, wraparound, mixture, jittered_star, jittered_periodic;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::vector<double> x = test::points_of(mc::Independent{mc::hash(1, seed)}, 36, 2),
                              y = test::points_of(mc::Stratified(36, mc::hash(2, seed), 2), 36, 2);
    star.add(std::pow(mc::l2_star_discrepancy({x, 2}), 2));
    periodic.add(std::pow(mc::periodic_l2_discrepancy({x, 2}), 2));
    const mc::L2Discrepancies all = mc::l2_discrepancies({x, 2});
    centered.add(all.centered * all.centered);
    wraparound.add(all.wraparound * all.wraparound);
    mixture.add(all.mixture * all.mixture);
    jittered_star.add(std::pow(mc::l2_star_discrepancy({y, 2}), 2));
    jittered_periodic.add(std::pow(mc::periodic_l2_discrepancy({y, 2}), 2));
  }
  star.expect(mc::random_mean_square(36, 2), "star");
  periodic.expect(mc::random_mean_square(36, 2), "periodic");
  const mc::L2Discrepancies random = mc::random_l2_discrepancies(36, 2);
  star.expect(random.star * random.star, "star");
  periodic.expect(random.periodic * random.periodic, "periodic");
  centered.expect(random.centered * random.centered, "centered");
  wraparound.expect(random.wraparound * random.wraparound, "wrap-around");
  mixture.expect(random.mixture * random.mixture, "mixture");
  jittered_star.expect(mc::jittered_star_mean_square(36, 2), "jittered, star");
  jittered_periodic.expect(mc::jittered_periodic_mean_square(36, 2), "jittered, periodic");
}

TEST(SmallestDistance, MatchesBruteForce) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto dim = static_cast<std::uint32_t>(1 + seed % 4);
    std::vector<double> x = test::points_of(mc::Independent{seed}, 2 + seed, dim);
    if (seed % 3 == 1)
      for (double& v : x) v = std::floor(32 * v) / 32;
    if (seed % 3 == 2) // near two opposite faces
      for (std::size_t i = 0; i < x.size(); i += dim) x[i] = x[i] < 0.5 ? x[i] / 16 : 1 - x[i] / 16;
    double plain = HUGE_VAL, periodic = HUGE_VAL;
    const PointList p{x, dim};
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double straight = 0, wrapped = 0;
        for (std::size_t k = 0; k < dim; ++k) {
          const double t = std::abs(p[i][k] - p[j][k]);
          straight += t * t;
          wrapped += std::pow(std::min(t, 1 - t), 2);
        }
        plain = std::min(plain, straight);
        periodic = std::min(periodic, wrapped);
      }
    EXPECT_NEAR(mc::smallest_distance(p).plain, std::sqrt(plain), 1e-14) << seed;
    EXPECT_NEAR(mc::smallest_distance(p).periodic, std::sqrt(periodic), 1e-14) << seed;
  }
}

// The mean of 400 sets has a standard error of 2.6 %, so the bound of 8 % is three standard errors.
TEST(SmallestDistance, OfRandomPointsIsThatOfThePoissonLimit) {
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    mean += mc::smallest_distance({test::points_of(mc::Independent{mc::hash(4, seed)}, 256, 2), 2}).periodic / 400;
  const double n = 256, limit = std::tgamma(1.5) * std::sqrt(2 / (n * n * std::acos(-1.0)));
  EXPECT_NEAR(mean, limit, 0.08 * limit);
}

TEST(SmallestDistance, PlainAndAroundTheFaces) {
  const std::vector<double> x = {0.0625, 0.5, 0.5, 0.5, 0.9375, 0.5};
  EXPECT_DOUBLE_EQ(mc::smallest_distance({x, 2}).plain, 0.4375);
  EXPECT_DOUBLE_EQ(mc::smallest_distance({x, 2}).periodic, 0.125);
  EXPECT_EQ(mc::smallest_distance({std::span(x).first(2), 2}).plain, HUGE_VAL);
}

} // namespace
