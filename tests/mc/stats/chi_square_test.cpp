#include <mc/stats/chi_square.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

TEST(ChiSquare, TailsAgreeWithTables) {
  EXPECT_NEAR(mc::chi_square_tail(3.841458820694124, 1), 0.05, 1e-12);
  EXPECT_NEAR(mc::chi_square_tail(18.307038053275146, 10), 0.05, 1e-12);
  EXPECT_NEAR(mc::normal_tail(1.959963984540054), 0.05, 1e-12);
  EXPECT_NEAR(mc::normal_quantile(0.05), 1.959963984540054, 1e-12);
  EXPECT_EQ(mc::chi_square_tail(5, 0), 1);
  EXPECT_NEAR(mc::chi_square_quantile(0.95, 3), 0.351846317749, 1e-10);
  EXPECT_NEAR(mc::chi_square_tail(mc::chi_square_quantile(0.01, 1000.5), 1000.5), 0.01, 1e-12);
}

// Reference: published power tables of chi-square tests of renderers at alpha = 1 %.
TEST(ChiSquare, NoncentralityOfTheWantedPower) {
  EXPECT_NEAR(mc::chi_square_noncentrality(199, 0.01, 0.99), 113.5, 0.02 * 113.5);
  EXPECT_NEAR(mc::chi_square_noncentrality(5049, 0.01, 0.99), 488.9, 0.02 * 488.9);
  EXPECT_NEAR(mc::chi_square_noncentrality(1, 0.01, 0.99), 24.0, 0.02 * 24.0);
}

TEST(ChiSquare, StatisticByHand) {
  const auto r = mc::chi_square({10, 20, 30}, {20, 20, 20});
  EXPECT_DOUBLE_EQ(r.statistic, 10);
  EXPECT_EQ(r.dof, 2);
  EXPECT_NEAR(r.p, std::exp(-5), 1e-12);
}

TEST(ChiSquare, PoolsWithoutLoss) {
  const auto r = mc::chi_square({1, 1, 2, 50, 1}, {1, 1, 1, 51, 1}, 0.01, 5);
  EXPECT_EQ(r.dof, 0); // 1 + 1 + 1 + 51 reaches 5 at the fourth cell, and the last cell joins it
  EXPECT_EQ(r.p, 1);
}

TEST(ChiSquare, ACountWhereNoneIsPossible) { EXPECT_EQ(mc::chi_square({100, 1}, {101, 0}).p, 0); }

// 400 runs at alpha = 5 %: the number of rejections is Binomial(400, 0.05), in [8, 34] with probability 0.9995.
TEST(ChiSquare, RejectsAtTheRateOfAlpha) {
  mc::Pcg random(4);
  int rejected = 0;
  for (int run = 0; run < 400; ++run) {
    std::vector<std::uint64_t> counts(50);
    for (int i = 0; i < 2000; ++i) ++counts[static_cast<std::size_t>(random.uniform<double>() * 50)];
    rejected += mc::chi_square(counts, std::vector<double>(50, 40.0)).p < 0.05;
  }
  EXPECT_GE(rejected, 8);
  EXPECT_LE(rejected, 34);
}

TEST(ChiSquare, RefusesNonsense) {
  EXPECT_THROW(mc::chi_square({1, 2}, {1}), mc::Error);
  EXPECT_THROW(mc::chi_square({1, 2}, {1, std::nan("")}), mc::Error);
  EXPECT_THROW(mc::chi_square({1, 2}, {4, -1}), mc::Error);
  EXPECT_THROW(mc::chi_square({1, 2}, {10, 10}), mc::Error);
}

} // namespace
