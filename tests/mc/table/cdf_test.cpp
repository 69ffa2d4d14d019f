#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/random/uniform.h>
#include <mc/table/cdf.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace {

// Every outcome of positive weight has an interval, and `find` returns it at both ends. Outcomes of weight 0 have none.
void expect_consistent(const std::vector<double>& w) {
  const mc::Cdf cdf(w);
  ASSERT_EQ(cdf.cdf(0), 0);
  ASSERT_EQ(cdf.cdf(w.size()), 1);
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (w[i] == 0) {
      ASSERT_EQ(cdf.pmf(i), 0) << i;
      continue;
    }
    ASSERT_GT(cdf.pmf(i), 0) << i;
    ASSERT_EQ(cdf.find(cdf.cdf(i)), i);
    ASSERT_EQ(cdf.find(std::nextafter(cdf.cdf(i + 1), 0.0)), i);
  }
}

TEST(Cdf, EveryPositiveWeightIsReachableAndNoOther) {
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  for (const std::vector<double>& w : std::vector<std::vector<double>>{{1},
                                                                       {0, 1},
                                                                       {1, 0},
                                                                       {0, 0, 5, 0},
                                                                       {1e-30, 1e30, 1e-30},
                                                                       {1e30, 1e-30, 0, 1e-30, 0},
                                                                       {tiny, tiny, tiny},
                                                                       {tiny, 0, huge, 0, tiny},
                                                                       {huge, huge, huge},
                                                                       {0, tiny, 1, tiny, tiny, tiny, 0},
                                                                       {1, 1, 1, 1, 1, 1, 1}})
    expect_consistent(w);
  std::vector<double> w(1 << 16);
  for (std::size_t i = 0; i < w.size(); ++i)
    w[i] = mc::hash(1, i) % 3 == 0 ? 0 : std::pow(10.0, 60 * mc::hash_uniform<double>(2, i) - 30);
  expect_consistent(w);
}

// The rounding of u n may put the last u of an interval into the next cell of the guide.
TEST(Cdf, EndsThatFallOnTheGuide) {
  for (std::size_t n = 1; n < 500; ++n) {
    std::vector<double> w(n, 1.0);
    expect_consistent(w);
    for (std::size_t i = 0; i < n; i += 3) w[i] = 2;
    expect_consistent(w);
  }
}

TEST(Cdf, TwoToThe24Entries) {
  std::vector<double> w(std::size_t{1} << 24, 1.0);
  w[5] = 1e30;
  const mc::Cdf cdf(w);
  for (std::size_t i = 0; i < w.size(); i += 4099) ASSERT_EQ(cdf.find(cdf.cdf(i)), i);
  EXPECT_EQ(cdf.find(std::nextafter(1.0, 0.0)), w.size() - 1);
}

TEST(Cdf, MassIsTheShareOfTheWeight) {
  std::vector<double> w(1000);
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = mc::hash_uniform<double>(3, i);
  const double sum = std::accumulate(w.begin(), w.end(), 0.0);
  const mc::Cdf cdf(w);
  for (std::size_t i = 0; i < w.size(); ++i) EXPECT_NEAR(cdf.pmf(i), w[i] / sum, 0x1p-52);
}

// A sky of 1024 x 512 pixels with a sun of 1e6 times its radiance. Every entry has the probability of its weight.
TEST(Cdf, SunInTheSky) {
  for (const std::size_t sun : {std::size_t{10}, std::size_t{262144}}) {
    std::vector<double> w(524288);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = 0.5 + mc::hash_uniform<double>(4, i);
    w[sun] = 1e12;
    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
    const mc::Cdf cdf(w);
    double total_variation = 0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      total_variation += std::abs(cdf.pmf(i) - w[i] / sum) / 2;
      ASSERT_NEAR(cdf.pmf(i) / (w[i] / sum), 1, 1e-3) << i; // pmf 1e-12, spacing of the cumulative sum 1e-16
    }
    EXPECT_LE(total_variation, 524288 * 0x1p-54);
    expect_consistent(w);
  }
}

void expect_error(const std::vector<double>& w, const std::string& message) {
  try {
    mc::Cdf cdf(w);
    FAIL() << "must throw: " << message;
  } catch (const mc::Error& e) {
    EXPECT_STREQ(e.what(), message.c_str());
  }
}

TEST(Cdf, RejectsNonsense) {
  expect_error({}, "table: no weights; at least one is needed");
  expect_error({1, -2}, "table: weights[1] = -2 is not finite and >= 0");
  expect_error({std::nan("")}, "table: weights[0] = nan is not finite and >= 0");
  expect_error({0, HUGE_VAL}, "table: weights[1] = inf is not finite and >= 0");
  expect_error({0, 0}, "table: all 2 weights are 0; at least one must be > 0");
}

} // namespace
