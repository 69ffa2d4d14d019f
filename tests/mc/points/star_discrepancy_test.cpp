#include "point_lists.h"

#include <mc/points/star_discrepancy.h>
#include <mc/random/hash.h>
#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

// Every box between coordinates, open and closed.
double by_all_boxes(mc::PointList p) {
  std::vector<std::vector<double>> grid(p.dim);
  for (std::size_t k = 0; k < p.dim; ++k) {
    for (std::size_t i = 0; i < p.size(); ++i) grid[k].push_back(p[i][k]);
    grid[k].push_back(1);
  }
  double worst = 0;
  std::vector<std::size_t> at(p.dim, 0);
  for (;;) {
    double volume = 1, open = 0, closed = 0;
    for (std::size_t k = 0; k < p.dim; ++k) volume *= grid[k][at[k]];
    for (std::size_t i = 0; i < p.size(); ++i) {
      bool below = true, within = true;
      for (std::size_t k = 0; k < p.dim; ++k) {
        below = below && p[i][k] < grid[k][at[k]];
        within = within && p[i][k] <= grid[k][at[k]];
      }
      open += below;
      closed += within;
    }
    const double n = static_cast<double>(p.size());
    worst = std::max({worst, volume - open / n, closed / n - volume});
    std::size_t k = 0;
    while (k < p.dim && ++at[k] == grid[k].size()) at[k++] = 0;
    if (k == p.dim) return worst;
  }
}

// Random and even sets, coordinates that repeat, 1 to 4 dimensions.
TEST(StarDiscrepancy, IsThatOfAllBoxes) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto dim = static_cast<std::uint32_t>(1 + seed % 4);
    const std::uint64_t n = 1 + mc::hash(1, seed) % (dim < 3 ? 24 : 9);
    std::vector<double> x =
        seed % 3 == 0 ? test::points_of(mc::Sobol(seed), n, dim) : test::points_of(mc::Independent{seed}, n, dim);
    if (seed % 3 == 1)
      for (double& v : x) v = std::floor(8 * v) / 8; // 0 among them
    const mc::StarDiscrepancy found = mc::star_discrepancy({x, dim});
    EXPECT_TRUE(found.exact());
    EXPECT_NEAR(found.lower, by_all_boxes({x, dim}), 1e-14) << "seed " << seed;
  }
}

// By exact rational arithmetic.
TEST(StarDiscrepancy, OfPointsThatAreKnown) {
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

TEST(StarDiscrepancy, BoundsHoldWhereverItStops) {
  const std::vector<double> x = test::points_of(mc::Sobol(2), 200, 3);
  const mc::StarDiscrepancy all = mc::star_discrepancy({x, 3});
  ASSERT_TRUE(all.exact());
  double width = 1;
  for (const std::uint64_t work : {0, 1000, 10'000, 100'000, 1'000'000}) {
    const mc::StarDiscrepancy some = mc::star_discrepancy({x, 3}, work);
    EXPECT_LE(some.lower, all.lower);
    EXPECT_GE(some.upper, all.lower);
    EXPECT_LE(some.upper - some.lower, width);
    width = some.upper - some.lower;
  }
}

TEST(StarDiscrepancy, AThousandPointsInThePlaneAreExact) {
  const std::vector<double> x = test::points_of(mc::Sobol(1), 1024, 2);
  const mc::StarDiscrepancy found = mc::star_discrepancy({x, 2});
  EXPECT_TRUE(found.exact());
  EXPECT_GT(found.lower, 1.0 / 1024);
  EXPECT_LT(found.lower, 0.01); // a (0,10,2)-net: at most (10 / 2 + 3 / 2) / 1024 [Niederreiter92]
}

} // namespace
