#include <mc/check/fit/tests/fit_test.h>

#include <gtest/gtest.h>

namespace {

// Counts the points of the blocks.
struct CountingTest {
  double points = 0;
  void count(const mc::SampleBlock& block) { points += static_cast<double>(block.points.size()); }
  mc::Findings judge(const mc::FitCounts& counts) const {
    return {{mc::statistical_check("points", 1e-6, points, 1, counts.setup.options.alpha, mc::Fault::shape, "many")}};
  }
};

TEST(FitTest, State_IsSharedByItsFunctions) {
  const mc::FitTest test = mc::make_fit_test(CountingTest{});
  EXPECT_FALSE(test.expect) << "the state has no such function";
  const std::vector<mc::Subject::Coordinates> points(7);
  test.count({points, {}, {}, {}, {}});
  test.count({points, {}, {}, {}, {}});
  const mc::Subject subject;
  const mc::SubjectOptions options;
  const mc::Pilot pilot;
  const mc::FitSetup setup{subject, options, pilot};
  const mc::Findings found = test.judge({.setup = setup});
  ASSERT_EQ(found.checks.size(), 1u);
  EXPECT_EQ(found.checks[0].statistic, 14);
  EXPECT_EQ(found.checks[0].verdict, mc::Verdict::fail);
  EXPECT_EQ(found.checks[0].detail, "many");
}

TEST(StatisticalCheck, PassHasNoDetail) {
  const mc::Check c = mc::statistical_check("a", 0.5, 1, 0.1, 0.01, mc::Fault::shape, "finding");
  EXPECT_EQ(c.verdict, mc::Verdict::pass);
  EXPECT_EQ(c.detail, "");
}

} // namespace
