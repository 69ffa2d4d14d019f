#include <integrands/expression_integral.h>
#include <integrands/joint_integrand.h>
#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using carlo::joined, carlo::JointIntegrand, carlo::parse_expression;

const std::vector<double> three_points = {0.25, 0.5, 0.75, 0.125, 0.5, 0.5};

TEST(JointIntegrand, OutputsFollowOneAnother) {
  const JointIntegrand all = joined(
      {joined({parse_expression("x", {.domain = "x=0:1,y=0:1"})}),
       joined({parse_expression("y", {.domain = "x=0:1,y=0:1"}), parse_expression("x*y", {.domain = "x=0:1,y=0:1"})})});
  ASSERT_EQ(all.outputs.size(), 3u);
  EXPECT_EQ(all.dim(), 2);
  std::vector<double> values(9);
  all.f(three_points, values);
  EXPECT_THAT(values, testing::ElementsAre(0.25, 0.5, 0.125, 0.75, 0.125, 0.09375, 0.5, 0.5, 0.25));
}

TEST(JointIntegrand, BoundOutputsEvaluateTheJointFunction) {
  JointIntegrand all =
      joined({parse_expression("x", {.domain = "x=0:1,y=0:1"}), parse_expression("y", {.domain = "x=0:1,y=0:1"})});
  all.f = [f = all.f](std::span<const double> u, std::span<double> values) {
    f(u, values);
    for (double& value : values) value += 10;
  };
  carlo::bind_outputs(all);
  EXPECT_EQ(all.outputs[1].f(std::vector{0.25, 0.5}), 10.5);
  std::vector<double> values(3);
  all.outputs[0].f_batch(three_points, values);
  EXPECT_THAT(values, testing::ElementsAre(10.25, 10.75, 10.5));
}

TEST(JointIntegrand, DifferentDimensionsAreRefused) {
  EXPECT_THAT(support::error_of([] {
                joined({parse_expression("x", {.domain = "x=0:1"}), parse_expression("y", {.domain = "x=0:1,y=0:1"})});
              }),
              testing::HasSubstr("'y' has 2 dimensions, 'x' 1"));
}

} // namespace
