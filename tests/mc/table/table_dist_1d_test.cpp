#include <mc/core/error.h>
#include <mc/random/pcg.h>
#include <mc/random/uniform.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/concept.h>

#include <gtest/gtest.h>

namespace {

template <class S> class TableDist1DTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TableDist1DTest, Scalars);

static_assert(mc::DiscreteDistribution<mc::TableDist1D<float>> && mc::InvertibleWarp<mc::TableDist1D<double>>);

// Points stay in their cell, also at its ends, so the density is never 0. n = 49 is included because 1/49*49 < 1 in
// double.
TYPED_TEST(TableDist1DTest, PointsStayInCellsOfPositiveWeight) {
  using S = TypeParam;
  for (const std::size_t n : {1u, 2u, 3u, 10u, 49u, 98u, 1000u, 4097u})
    for (const auto& interval : {mc::Interval<S>(0, 1), mc::Interval<S>(-3, S(0.1)), mc::Interval<S>(100, 101)}) {
      std::vector<double> w(n, 0.0);
      for (std::size_t i = n > 1; i < n; i += 2) w[i] = 1 + static_cast<double>(i % 5);
      const mc::TableDist1D<S> table(w, interval);
      for (std::size_t i = 0; i < n; ++i)
        for (const S u :
             {S(table.cdf().cdf(i)), S(std::nextafter(S(table.cdf().cdf(i + 1)), S(0))), mc::hash_uniform<S>(1, i)}) {
          if (!(u < 1)) continue;
          const S x = table.sample(u);
          const auto s = table.sample_index(u);
          ASSERT_TRUE(interval.contains(x));
          ASSERT_GT(w[s.index], 0);
          ASSERT_GE(s.u_remapped, 0);
          ASSERT_LT(s.u_remapped, 1);
          ASSERT_GT(table.pdf(x), 0) << "n " << n << ", u " << u << ", x " << x;
          ASSERT_EQ(table.cell(x), s.index) << "n " << n << ", u " << u << ", x " << x;
        }
    }
}

TYPED_TEST(TableDist1DTest, InvertsSamples) {
  using S = TypeParam;
  const mc::TableDist1D<S> table(std::vector<double>{1, 0, 3, 2, 0, 5});
  for (int k = 0; k < 10000; ++k) {
    const S u = mc::hash_uniform<S>(2, k);
    EXPECT_NEAR(table.invert(table.sample(u)), u, 6 * std::numeric_limits<S>::epsilon());
  }
}

// At the ends of cells rounding may move a point out. The correction must not exceed rounding, which is far smaller for
// numbers near lo than near hi.
TYPED_TEST(TableDist1DTest, InvertsTheEndsOfCells) {
  using S = TypeParam;
  const S eps = std::numeric_limits<S>::epsilon(), last = mc::one_minus_epsilon<S>;
  for (std::size_t n = 2; n < 300; ++n)
    for (std::size_t cell = 0; cell < n; ++cell) {
      std::vector<double> w(n, 0.0);
      w[cell] = 1;
      const mc::TableDist1D<S> table(w);
      for (const S u : {S(0), last}) {
        const S x = table.sample(u), ulp = std::nextafter(x, S(2)) - x;
        ASSERT_LE(std::abs(table.invert(x) - u), 4 * eps + 2 * ulp * S(n)) << "cell " << cell << " of " << n;
      }
    }
}

// Random tables and intervals.
TYPED_TEST(TableDist1DTest, InverseWithinItsBoundOnAnyInterval) {
  using S = TypeParam;
  const S eps = std::numeric_limits<S>::epsilon();
  mc::Pcg random(11);
  const auto uniform = [&] { return random.template uniform<S>(); };
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> weights(1 + random.next32() % 300);
    for (double& w : weights) w = uniform() < S(0.1) ? 0 : std::pow(static_cast<double>(uniform()), 3);
    weights[random.next32() % weights.size()] = 1;
    const S n = static_cast<S>(weights.size()), lo = std::exp2(20 * uniform() - 10) * (uniform() - S(0.5));
    const S hi = lo + std::exp2(20 * uniform() - 10), largest = std::max(std::abs(lo), std::abs(hi));
    if (hi - lo < 8 * n * eps * largest) continue; // cells too narrow for S
    const mc::TableDist1D<S> table(weights, {lo, hi});
    for (int j = 0; j < 100; ++j) {
      const S u = uniform(), x = table.sample(u), size = std::max(std::abs(x), std::abs(lo));
      const S ulp = std::nextafter(size, std::numeric_limits<S>::infinity()) - size;
      ASSERT_LE(std::abs(table.invert(x) - u), 4 * eps + 4 * table.pmf(table.cell(x)) * ulp * n / (hi - lo))
          << "[" << lo << ", " << hi << "], " << n << " cells, u = " << u;
    }
  }
}

TYPED_TEST(TableDist1DTest, DensityIsOffTheIntervalZero) {
  const mc::TableDist1D<TypeParam> table(std::vector<double>{1, 3}, {2, 4});
  EXPECT_EQ(table.pdf(TypeParam(1.9)), 0);
  EXPECT_EQ(table.pdf(TypeParam(4.1)), 0);
  EXPECT_EQ(table.pdf(TypeParam(2.5)), TypeParam(0.25));
  EXPECT_EQ(table.pdf(4), TypeParam(0.75));
}

// 524288 cells in float: each cell that 24-bit numbers can reach is sampled with its own index.
TYPED_TEST(TableDist1DTest, LargeTables) {
  using S = TypeParam;
  std::vector<double> w(524288);
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = static_cast<double>(i % 3);
  const mc::TableDist1D<S> table(w);
  for (int k = 0; k < 200000; ++k) {
    const S u = mc::hash_uniform<S>(3, k), x = table.sample(u);
    ASSERT_EQ(table.cell(x), table.sample_index(u).index);
    ASSERT_EQ(table.pdf(x), S(table.cdf().pmf(table.cell(x)) * 524288));
  }
}

TEST(TableDist1D, FromFunctionAndCast) {
  const auto table = mc::TableDist1D<double>::from_function([](double x) { return x; }, 4, {0, 4});
  EXPECT_DOUBLE_EQ(table.pmf(3), 3.5 / 8);
  EXPECT_EQ(table.cast<float>().pdf(3.5f), static_cast<float>(table.pdf(3.5)));
}

// 1 - v and v both round, so that their sum may fall below lo.
TEST(TableDist1D, SamplesStayInTheInterval) {
  std::vector<double> weights(100'000, 1e-12);
  weights[0] = 1;
  const mc::TableDist1D<double> table(weights, mc::Interval<double>(1100, 1200));
  for (int k = 0; k < 2'000'000; k += 7) {
    const double x = table.sample(k * 0x1p-53);
    ASSERT_GE(x, 1100) << k;
    ASSERT_GT(table.pdf(x), 0) << k;
  }
}

TEST(TableDist1D, InverseLiesBelowOne) {
  const mc::TableDist1D<float> table(std::vector<double>{1, 2, 3, 4}, mc::Interval<float>(1000, 1001));
  mc::Pcg random(1);
  for (int k = 0; k < 100'000; ++k) {
    const float u = table.invert(table.sample(random.uniform<float>()));
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
  }
  EXPECT_LT(table.invert(1001), 1);
  EXPECT_LT(table.sample_index(table.invert(1001)).index, 4u);
}

TEST(TableDist1D, RefusesAnIntervalThatTheScalarCannotMeasure) {
  const std::vector<double> weights{1, 2};
  EXPECT_THROW(mc::TableDist1D<float>(weights, mc::Interval<float>(0, 1e-40f)), mc::Error);
  EXPECT_THROW(mc::TableDist1D<float>(weights, mc::Interval<float>(0, 3e38f)), mc::Error);
}

} // namespace
