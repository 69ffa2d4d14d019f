#include "point_lists.h"

#include <mc/points/star_discrepancy.h>
#include <mc/random/hash.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

// Random, Sobol' and jittered sets, repeated coordinates including 0, in 1 to 4 dimensions.
TEST(StarDiscrepancy, MatchesBruteForce) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto dim = static_cast<std::uint32_t>(1 + seed % 4);
    const std::uint64_t most = dim < 4 ? 40 : seed % 40 == 3 ? 24 : 12, n = 1 + mc::hash(1, seed) % most;
    std::vector<double> x = test::points_of(mc::Independent{seed}, n, dim);
    if (seed % 5 == 0) x = test::points_of(mc::Sobol(seed), n, dim);
    if (seed % 5 == 1) x = test::points_of(mc::Stratified(static_cast<std::uint32_t>(n), seed, dim), n, dim);
    if (seed % 5 == 2)
      for (double& v : x) v = std::floor(8 * v) / 8;
    if (seed % 5 == 3)
      for (double& v : x) v *= v * v;
    const mc::StarDiscrepancy found = mc::star_discrepancy({x, dim});
    EXPECT_TRUE(found.exact());
    EXPECT_NEAR(found.lower, test::star_by_all_boxes({x, dim}), 1e-14) << "seed " << seed;
  }
}

// Reference values by exact rational arithmetic.
TEST(StarDiscrepancy, MatchesKnownValues) {
  struct {
    std::size_t n, dim;
    double value;
  } constexpr known[] = {{1, 1, 0.99706170421155726},  {7, 1, 0.97943192948090108},  {16, 2, 0.95515141864143871},
                         {40, 2, 0.88592160131844389}, {12, 3, 0.96679184377368033}, {8, 4, 0.97888034987630734}};
  for (const auto& k : known) {
    const std::vector<double> x = test::scattered(k.n, k.dim);
    EXPECT_NEAR(mc::star_discrepancy({x, k.dim}).lower, k.value, 1e-14);
  }
  const std::vector<double> net = test::hammersley(0), shifted = test::hammersley(1.0 / 16);
  EXPECT_DOUBLE_EQ(mc::star_discrepancy({net, 2}).lower, 5.0 / 16);
  EXPECT_DOUBLE_EQ(mc::star_discrepancy({shifted, 2}).lower, 55.0 / 256);
}

TEST(StarDiscrepancy, OnALineItIsNiederreitersFormula) {
  std::vector<double> x = test::points_of(mc::Independent{9}, 1000, 1);
  const double found = mc::star_discrepancy({x, 1}).upper;
  std::sort(x.begin(), x.end());
  double expected = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    expected = std::max(expected, std::abs(x[i] - (2.0 * static_cast<double>(i) + 1) / 2000));
  EXPECT_NEAR(found, expected + 1.0 / 2000, 1e-14);
}

// The bounds must hold for any work, and be close to each other for much work.
TEST(StarDiscrepancy, BoundsHoldForAnyWork) {
  for (const std::uint32_t dim : {2u, 3u, 5u}) {
    const std::vector<double> x = test::points_of(mc::Sobol(2), 200, dim);
    const mc::StarDiscrepancy all = mc::star_discrepancy({x, dim});
    ASSERT_TRUE(all.exact());
    double ratio = HUGE_VAL;
    for (const std::uint64_t work : {0, 1000, 10'000, 100'000, 1'000'000, 10'000'000}) {
      const mc::StarDiscrepancy some = mc::star_discrepancy({x, dim}, work);
      EXPECT_GT(some.lower, 0);
      EXPECT_LE(some.lower, all.lower);
      EXPECT_GE(some.upper, all.lower);
      ratio = some.upper / some.lower;
    }
    EXPECT_LT(ratio, 4) << dim;
  }
}

// Four times the estimate suffices. A fifth of it does not for a set where few parts can be discarded.
TEST(StarDiscrepancy, StepsAreAsEstimated) {
  for (const auto& [n, dim] : {std::pair{2048u, 2u}, {512u, 3u}, {256u, 4u}, {100u, 5u}, {64u, 8u}}) {
    const std::vector<double> x = test::points_of(mc::Sobol(1), n, dim);
    const double steps = mc::exact_star_steps(n, dim);
    EXPECT_TRUE(mc::star_discrepancy({x, dim}, static_cast<std::uint64_t>(4 * steps)).exact()) << dim;
  }
  const std::vector<double> x = test::points_of(mc::Sobol(1), 512, 4);
  EXPECT_FALSE(mc::star_discrepancy({x, 4}, static_cast<std::uint64_t>(0.2 * mc::exact_star_steps(512, 4))).exact());
}

// A set in eight dimensions that is too large for its work gives a lower and an upper bound.
TEST(StarDiscrepancy, ManyDimensions_ReturnsBounds) {
  const std::vector<double> x = test::points_of(mc::Sobol(3), 256, 8);
  const mc::StarDiscrepancy found = mc::star_discrepancy({x, 8}, 30'000'000);
  EXPECT_FALSE(found.exact());
  EXPECT_GT(found.lower, 0.04);
  EXPECT_LT(found.lower, found.upper);
  EXPECT_LT(found.upper, 0.5);
}

// Reference values by an independent branch and bound over all boxes.
TEST(StarDiscrepancy, ThousandsOfPointsAreExact) {
  const std::vector<double> plane = test::points_of(mc::Sobol(1), 4096, 2),
                            space = test::points_of(mc::Sobol(1), 512, 3), four = test::points_of(mc::Sobol(1), 256, 4);
  EXPECT_NEAR(mc::star_discrepancy({plane, 2}).upper, 0.001106379, 1e-9);
  EXPECT_NEAR(mc::star_discrepancy({space, 3}).upper, 0.013997266, 1e-9);
  EXPECT_NEAR(mc::star_discrepancy({four, 4}).upper, 0.038878794, 1e-9);
  const std::vector<double> large = test::points_of(mc::Independent{1}, 4096, 3);
  EXPECT_TRUE(mc::star_discrepancy({large, 3}).exact());
}

TEST(StarDiscrepancy, AThousandPointsInThePlaneAreExact) {
  const std::vector<double> x = test::points_of(mc::Sobol(1), 1024, 2);
  const mc::StarDiscrepancy found = mc::star_discrepancy({x, 2});
  EXPECT_TRUE(found.exact());
  EXPECT_GT(found.lower, 1.0 / 1024);
  EXPECT_LT(found.lower, 0.01); // a (0,10,2)-net: at most (10 / 2 + 3 / 2) / 1024 [Niederreiter92]
}

} // namespace
