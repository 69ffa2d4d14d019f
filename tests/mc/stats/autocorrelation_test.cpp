#include <mc/stats/autocorrelation.h>

#include <mc/random/pcg.h>
#include <mc/warp/normal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

// x_i = r x_(i-1) + sqrt(1 - r^2) noise: correlations r^k, autocorrelation time (1 + r) / (1 - r).
std::vector<double> autoregression(double r, std::size_t n, std::uint64_t seed) {
  mc::Pcg random(seed);
  const mc::Normal<double> normal;
  std::vector<double> x{normal.sample(random.uniform<double>())};
  while (x.size() < n) x.push_back(r * x.back() + std::sqrt(1 - r * r) * normal.sample(random.uniform<double>()));
  return x;
}

TEST(Autocorrelation, Time_IsThatOfAnAutoregression) {
  for (const double r : {-0.5, 0.0, 0.3, 0.9, 0.99}) {
    const double truth = std::max((1 + r) / (1 - r), 1.0);
    EXPECT_NEAR(mc::autocorrelation_time(autoregression(r, 400'000, 3)), truth, 0.1 * truth) << "r = " << r;
  }
}

TEST(Autocorrelation, Time_OfEqualAndFewValues) {
  EXPECT_EQ(mc::autocorrelation_time(std::vector<double>(1000, 2.5)), 1000);
  EXPECT_EQ(mc::autocorrelation_time(std::vector<double>{1}), 1);
  EXPECT_GE(mc::autocorrelation_time(std::vector<double>{1, 2}), 1);
}

// The correlation of thinned values is hidden in its noise.
TEST(Autocorrelation, ThinnedValuesAreIndependent) {
  const std::vector<double> x = autoregression(0.9, 400'000, 5);
  const std::size_t step = mc::thinning_distance(mc::autocorrelation_time(x), x.size());
  double sum = 0, pairs = 0;
  for (std::size_t i = 0; i + step < x.size(); i += step, pairs += 1) sum += x[i] * x[i + step];
  EXPECT_LE(std::abs(sum / pairs), 3 / std::sqrt(pairs));
  EXPECT_LE(step, 200u);
  EXPECT_EQ(mc::thinning_distance(1, 1000), 1u);
}

} // namespace
