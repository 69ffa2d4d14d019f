#include <mc/stats/ks_test.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

double identity(double x) { return x; }

TEST(Ks, LimitingTail) {
  EXPECT_NEAR(mc::kolmogorov_tail(1.3580986393225505), 0.05, 1e-10);
  EXPECT_NEAR(mc::kolmogorov_tail(1.6276236115189503), 0.01, 1e-10);
  EXPECT_NEAR(mc::kolmogorov_tail(0.9999999), mc::kolmogorov_tail(1.0000001), 1e-6); // both expansions agree
  EXPECT_EQ(mc::kolmogorov_tail(0), 1);
  EXPECT_NEAR(mc::kolmogorov_tail(0.2), 1, 1e-11);
}

TEST(Ks, StatisticByHand) {
  const mc::KsTest r = mc::ks_test({0.1, 0.2, 0.9}, identity);
  EXPECT_NEAR(r.d, 2.0 / 3 - 0.2, 1e-15);
  EXPECT_EQ(r.location, 0.2);
}

// 1000 runs of 30 samples at 5 %: Binomial(1000, 0.05) lies in [25, 80] with probability 0.9998.
TEST(Ks, RejectsAtTheRateOfAlpha) {
  mc::Pcg random(5);
  int rejected = 0;
  for (int run = 0; run < 1000; ++run) {
    std::vector<double> u(30);
    for (double& x : u) x = random.uniform<double>();
    rejected += mc::ks_test(u, identity).p < 0.05;
  }
  EXPECT_GE(rejected, 25);
  EXPECT_LE(rejected, 80);
}

// A sampler in the unit ball claimed to be Lambertian: the cosine has the distribution function c^4 instead of c^2. 93
// samples suffice at p = 0.001.
TEST(Ks, FindsTheInBallLambertian) {
  mc::Pcg random(6);
  int found = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<double> c(93);
    for (double& x : c) x = std::sqrt(std::sqrt(random.uniform<double>()));
    found += mc::ks_test(c, [](double x) { return x * x; }).p < 0.001;
  }
  EXPECT_GE(found, 180);
}

TEST(Ks, RefusesNonsense) {
  EXPECT_THROW(mc::ks_test({}, identity), mc::Error);
  EXPECT_THROW(mc::ks_test({0.5, std::nan("")}, identity), mc::Error);
}

} // namespace
