#include <mc/estimate/moments.h>
#include <mc/estimate/russian_roulette.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

// 4 sigma: a false alarm in 6e-5 of seeds; the seed is fixed.
TEST(RussianRoulette, KeepsTheMean) {
  for (const double p : {0.01, 0.5, 0.99, 1.0}) {
    mc::Moments m;
    for (std::uint64_t i = 0; i < 100'000; ++i) m.add(mc::russian_roulette(p, mc::hash_uniform<double>(3, i)).weight);
    EXPECT_LE(std::abs(m.mean() - 1), 4 * m.std_error() + 1e-12) << p;
  }
}

TEST(RussianRoulette, CertainSurvivalCostsNothing) {
  const auto r = mc::russian_roulette(1.0f, std::nextafter(1.0f, 0.0f));
  EXPECT_TRUE(r.survives);
  EXPECT_EQ(r.weight, 1.0f);
}

TEST(RussianRoulette, RefusesWhatWouldBias) {
  for (const double p : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(mc::russian_roulette(p, 0.5), mc::Error) << p;
}

// 4 sigma: a false alarm in 6e-5 of seeds; the seed is fixed.
TEST(Splitting, KeepsTheMeanAndTheNextWholeNumbers) {
  for (const double expected : {0.01, 0.5, 1.0, 1.25, 7.9, 1000.5}) {
    mc::Moments m;
    for (std::uint64_t i = 0; i < 100'000; ++i) {
      const auto s = mc::split(expected, mc::hash_uniform<double>(4, i));
      ASSERT_LT(std::abs(s.copies - expected), 1);
      m.add(s.copies * s.weight);
    }
    EXPECT_LE(std::abs(m.mean() - 1), 4 * m.std_error() + 1e-12) << expected;
  }
}

TEST(Splitting, WholeNumbersAreCertain) {
  for (const float u : {0.0f, 0.5f, std::nextafter(1.0f, 0.0f)}) {
    EXPECT_EQ(mc::split(3.0f, u).copies, 3u);
    EXPECT_EQ(mc::split(1.0f, u).weight, 1.0f);
  }
  EXPECT_EQ(mc::split(1e-30f, 0.0f).copies, 1u);
}

TEST(Splitting, RefusesWhatWouldBiasOrNeverEnd) {
  for (const double n : {0.0, -1.0, 2e6, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(mc::split(n, 0.5), mc::Error) << n;
}

TEST(RussianRoulette, RefusesWhatHasNoInverse) {
  EXPECT_THROW(mc::russian_roulette(1e-40f, 0.0f), mc::Error);
  EXPECT_THROW(mc::split(1e-40f, 0.0f), mc::Error);
  EXPECT_TRUE(std::isfinite(mc::russian_roulette(2e-38f, 0.0f).weight));
}

} // namespace
