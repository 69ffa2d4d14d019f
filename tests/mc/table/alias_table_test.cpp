#include <mc/core/error.h>
#include <mc/random/uniform.h>
#include <mc/table/alias_table.h>

#include <gtest/gtest.h>

#include <numeric>

namespace {

static_assert(mc::DiscreteDistribution<mc::AliasTable>);

// Tries u at each end of each half of each bin. These u select all outcomes of positive weight, and none of weight 0.
TEST(AliasTable, ReachesEveryPositiveWeightAndNoOther) {
  for (const std::vector<double>& w : std::vector<std::vector<double>>{{1},
                                                                       {0, 1},
                                                                       {1, 0, 0},
                                                                       {1, 2, 3, 4},
                                                                       {1, 1, 1},
                                                                       {1e-3, 1, 0, 1e-3},
                                                                       {0, 5e-324, 0},
                                                                       {0.1, 0.2, 0.3, 0.4, 0, 1e-8}}) {
    const mc::AliasTable table(w);
    std::vector<double> mass(w.size());
    constexpr int steps = 100'000;
    for (int k = 0; k <= steps; ++k) {
      const auto s = table.sample_index(k == steps ? mc::one_minus_epsilon<double> : double(k) / steps);
      ASSERT_GT(w[s.index], 0);
      ASSERT_EQ(s.pmf, table.pmf(s.index));
      ASSERT_GE(s.u_remapped, 0);
      ASSERT_LT(s.u_remapped, 1);
      mass[s.index] += 1.0 / steps;
    }
    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
    for (std::size_t i = 0; i < w.size(); ++i) {
      EXPECT_NEAR(table.pmf(i), w[i] / sum, 1e-15);
      EXPECT_NEAR(mass[i], table.pmf(i), 2.0 * static_cast<double>(w.size()) / steps);
    }
  }
}

// The mean and second moment of the remapped number, and its correlation with the outcome, agree within 5 standard
// deviations (alpha 1e-6 each).
TEST(AliasTable, RemappedIsUniformAndIndependent) {
  const std::vector<double> w{1, 5, 0, 2, 0.5, 7};
  const mc::AliasTable table(w);
  double first = 0, second = 0, cross = 0;
  constexpr int n = 200'000;
  for (int k = 0; k < n; ++k) {
    const auto s = table.sample_index(mc::hash_uniform<double>(8, k));
    first += s.u_remapped - 0.5;
    second += mc::sqr(s.u_remapped) - 1.0 / 3;
    cross += (s.u_remapped - 0.5) * (static_cast<double>(s.index) - 3.5);
  }
  EXPECT_LE(std::abs(first), 5 * std::sqrt(n / 12.0));
  EXPECT_LE(std::abs(second), 5 * std::sqrt(n * 4 / 45.0));
  EXPECT_LE(std::abs(cross), 5 * std::sqrt(n / 12.0) * 3.5);
}

TEST(AliasTable, RejectsNonsense) {
  EXPECT_THROW(mc::AliasTable(std::vector<double>{}), mc::Error);
  EXPECT_THROW(mc::AliasTable(std::vector<double>{1, -1}), mc::Error);
  EXPECT_THROW(mc::AliasTable(std::vector<double>{0, 0}), mc::Error);
}

} // namespace
