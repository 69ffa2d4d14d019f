#include <mc/check/fit/tests/density_ratio.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

// Density 1 + sin(2 pi x): correct samples by rejection, or uniform samples that ignore it.
mc::Check levels(std::uint64_t seed, bool right, double alpha) {
  mc::Pcg random(seed);
  mc::DensityRatioTest levels;
  const auto density = [](double x) { return 1 + std::sin(2 * mc::pi<double> * x); };
  for (int i = 0; i < 10'000; ++i) {
    double x = random.uniform<double>();
    while (right && 2 * random.uniform<double>() > density(x)) x = random.uniform<double>();
    levels.add_sample(density(x), 1, density(x));
  }
  for (int i = 0; i < 5000; ++i) {
    const double x = random.uniform<double>();
    levels.add_expected(density(x), density(x), 1);
  }
  return levels.test(1, alpha);
}

// 300 runs at 10 %: below 48 with probability 0.9995.
TEST(DensityRatioTest, CorrectSamples_RejectedAtMostAtAlpha) {
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) rejected += levels(seed, true, 0.1).verdict == mc::Verdict::fail;
  EXPECT_LE(rejected, 48);
  EXPECT_GE(rejected, 8);
}

TEST(DensityRatioTest, SamplesIgnoreDensity_Fails) { EXPECT_EQ(levels(1, false, 1e-3).verdict, mc::Verdict::fail); }

} // namespace
