#include <mc/stats/t_test.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/warp/normal.h>

#include <gtest/gtest.h>

namespace {

TEST(TTest, ByHand) {
  mc::Moments m;
  for (const double x : {1.0, 2.0, 3.0}) m.add(x);
  const mc::TTest r = mc::t_test(m, 1);
  EXPECT_NEAR(r.t, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(r.p, 0.22540333075851662, 1e-12); // dof 2: 1 - t / sqrt(t^2 + 2)
  EXPECT_EQ(mc::t_test(m, 2).p, 1);
}

TEST(TTest, EqualValues) {
  mc::Moments m;
  m.add(0.5);
  m.add(0.5);
  EXPECT_EQ(mc::t_test(m, 0.5).p, 1);
  EXPECT_EQ(mc::t_test(m, 0.6).p, 0);
}

// 1000 runs at 5 %: the number of rejections lies in [25, 80] with probability 0.9998. The test must detect the stated
// difference in most runs.
TEST(TTest, RejectsAtTheRateOfAlphaAndCatchesWhatItSays) {
  mc::Pcg random(7);
  int rejected = 0, caught = 0;
  for (int run = 0; run < 1000; ++run) {
    mc::Moments m;
    for (int i = 0; i < 50; ++i) m.add(random.uniform<double>());
    rejected += mc::t_test(m, 0.5).p < 0.05;
    const double detectable = mc::t_test(m, 0.5, 0.05).detectable;
    caught += mc::t_test(m, 0.5 + detectable).p < 0.05;
  }
  EXPECT_GE(rejected, 25);
  EXPECT_LE(rejected, 80);
  EXPECT_GE(caught, 970);
}

// Variances of normal values have chi-square distributions, here of 1 and 3 degrees of freedom, with relative variance
// 2 / dof. The exact value for a sum is 2 sum v^2 / d / (sum v)^2. Averages over 1000 sums of 64 variances.
TEST(TTest, DegreesOfFreedomBehindSums) {
  mc::VarianceSum one;
  EXPECT_EQ(one.dof(), mc::infinity<double>);
  one.add(4, 3);
  EXPECT_NEAR(one.dof(), 3, 1e-12);
  mc::Pcg rng(3);
  const auto normal = [&] { return mc::Normal<double>().sample(rng.uniform<double>()); };
  double dofs = 0;
  for (int i = 0; i < 1000; ++i) {
    mc::VarianceSum sum;
    for (int k = 0; k < 32; ++k) {
      sum.add(mc::sqr(normal()), 1);
      sum.add(2 * (mc::sqr(normal()) + mc::sqr(normal()) + mc::sqr(normal())) / 3, 3);
    }
    dofs += sum.dof();
  }
  const double dof = mc::sqr(32.0 * 3) / (32 * (1 + 4 / 3.0));
  EXPECT_NEAR(dofs / 1000, dof, 0.02 * dof);
}

TEST(TTest, WelchsDegreesOfFreedom) {
  EXPECT_NEAR(mc::welch_dof(1, 10, 1, 10), 20, 1e-12);
  EXPECT_NEAR(mc::welch_dof(2, 7, 0, 99), 7, 1e-12);
  EXPECT_NEAR(mc::welch_dof(1, 4, 3, 6), 16 / (1 / 4.0 + 9 / 6.0), 1e-12);
  EXPECT_NEAR(mc::welch_dof(1e-300, 4, 3e-300, 6), 16 / (1 / 4.0 + 9 / 6.0), 1e-12);
  EXPECT_EQ(mc::welch_dof(0, 4, 0, 6), 10);
  EXPECT_NEAR(mc::student_tail(-1, 1), 0.5, 1e-12);
  EXPECT_NEAR(mc::student_quantile(0.5, 1), 1, 1e-12);
  EXPECT_NEAR(mc::student_tail(mc::student_quantile(0.05, 8), 8), 0.05, 1e-12);
}

TEST(TTest, RefusesNonsense) {
  mc::Moments m;
  EXPECT_THROW(mc::t_test(m, 0), mc::Error);
  m.add(1);
  m.add(std::nan(""));
  EXPECT_THROW(mc::t_test(m, 0), mc::Error);
}

} // namespace
