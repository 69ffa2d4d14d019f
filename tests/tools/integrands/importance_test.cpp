#include <integrands/importance.h>

#include <mc/core/types.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace {

using carlo::ImportanceDensity, carlo::JointIntegrand, carlo::UnitCubeIntegral;

// v = sqrt(u) has the density 2 v; samples below 1/4 are dropped.
ImportanceDensity ramp() {
  return {1, [](std::span<const double> u, std::span<double> v, std::span<double> densities) {
            for (std::size_t i = 0; i < u.size(); ++i) {
              v[i] = std::sqrt(u[i]);
              densities[i] = v[i] < 0.25 ? 0 : 2 * v[i];
            }
          }};
}

JointIntegrand squares() {
  UnitCubeIntegral e;
  e.name = "x2";
  e.dim = 1;
  e.truth = 1.0 / 3;
  e.bounds = {{"x", 0, 1}};
  e.f = [](UnitCubeIntegral::UnitPoint u) { return u[0] < 0.25 ? NAN : u[0] * u[0]; };
  e.describe_point = [](UnitCubeIntegral::UnitPoint u) { return fmt::format("x = {}", u[0]); };
  UnitCubeIntegral one = e;
  one.f = [](UnitCubeIntegral::UnitPoint) { return 1.0; };
  return carlo::joined(std::vector{e, one});
}

TEST(Importance, DividesByTheDensity) {
  const JointIntegrand f = importance_sampled(squares(), ramp());
  std::vector<double> values(6);
  f.f(std::vector{0.25, 0.01, 0.81}, values); // v = 0.5, 0.1, 0.9
  EXPECT_THAT(values, testing::ElementsAre(0.25, 1, 0, 0, testing::DoubleEq(0.45), testing::DoubleEq(1 / 1.8)));
  EXPECT_EQ(f.outputs[0].f(std::vector{0.25}), 0.25);
  EXPECT_EQ(f.outputs[1].f(std::vector{0.01}), 0) << "the integrand is not evaluated where the density is 0";
}

TEST(Importance, DescribesSamplesAndKeepsTheTruth) {
  const JointIntegrand f = importance_sampled(squares(), ramp());
  EXPECT_EQ(f.outputs[0].describe_point(std::vector{0.25}), "x = 0.5");
  EXPECT_EQ(f.outputs[0].truth, 1.0 / 3);
  EXPECT_TRUE(f.outputs[0].bounds.empty()) << "u is no coordinate of the variables";
}

} // namespace
