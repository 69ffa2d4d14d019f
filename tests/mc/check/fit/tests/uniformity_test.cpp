#include <mc/check/fit/tests/uniformity.h>

#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

std::vector<mc::Subject::Coordinates> points(std::uint64_t seed, int n, double power = 1, double pull = 0) {
  mc::Pcg random(seed);
  std::vector<mc::Subject::Coordinates> p;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform<double>(), v = random.uniform<double>();
    p.push_back({std::pow(u, power), (1 - pull) * v + pull * u, 0});
  }
  return p;
}

// 400 runs at 10 %: Binomial(400, 0.1) is between 16 and 66 with probability 0.9999. Dependent tests make Sidak's
// correction conservative.
TEST(Uniformity, UniformPoints_RejectedAtRateAlpha) {
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    rejected += mc::test_uniformity(points(seed, 2000), 2, 0, 0.1, 1)->verdict == mc::Verdict::fail;
  EXPECT_LE(rejected, 66);
  EXPECT_GE(rejected, 12);
}

TEST(Uniformity, WrongPowersAndCorrelations_Fail) {
  const auto bent = mc::test_uniformity(points(1, 100'000, 1.02), 2, 0, 0.001, 1),
             tied = mc::test_uniformity(points(2, 100'000, 1, 0.02), 2, 0, 0.001, 1);
  EXPECT_EQ(bent->verdict, mc::Verdict::fail);
  EXPECT_THAT(bent->detail, testing::HasSubstr("u[0]"));
  EXPECT_EQ(tied->verdict, mc::Verdict::fail);
}

TEST(Uniformity, ErrorWithinInverseBound_Passes) {
  EXPECT_EQ(mc::test_uniformity(points(1, 10'000, 1.0001), 2, 1e-4, 0.5, 1)->verdict, mc::Verdict::pass);
  EXPECT_FALSE(mc::test_uniformity(points(1, 10'000), 2, 1e-2, 0.5, 1).has_value());
}

} // namespace
