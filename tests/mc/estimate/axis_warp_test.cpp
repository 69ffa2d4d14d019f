#include <mc/estimate/axis_warp.h>
#include <mc/estimate/integrate/evaluate.h>
#include <mc/estimate/integrate/run.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace mc::detail;

TEST(AxisWarp, SlopeIsTheDerivative) {
  constexpr double step = 1e-6;
  const AxisWarp map(5, 1, 0);
  for (const double u : {0.01, 0.3, 0.77})
    EXPECT_NEAR(map.slope(u), (map(u + step) - map(u - step)) / (2 * step), 1e-9);
}

TEST(AxisWarp, JacobiansOfPointsAreProductsOfSlopes) {
  constexpr int dim = 3;
  std::vector<double> u(300 * dim), x(300 * dim), jacobians(300);
  const auto expect_products = [&](auto net, auto warped) {
    mc::fill_points(net, 100, dim, u);
    mc::fill_points(warped, 100, dim, x, jacobians);
    for (std::size_t i = 0; i < jacobians.size(); ++i) {
      double product = 1;
      for (std::size_t d = 0; d < dim; ++d) {
        const AxisWarp map(9, dim, d);
        EXPECT_EQ(x[i * dim + d], map(u[i * dim + d]));
        product *= map.slope(u[i * dim + d]);
      }
      EXPECT_DOUBLE_EQ(jacobians[i], product) << i;
    }
  };
  expect_products(mc::ScrambledSobol{9}, mc::ScrambledSobol{9, true});
  expect_products(mc::InterlacedSobol{9}, mc::InterlacedSobol{9, true});
}

TEST(AxisWarp, ReplicatesMoveAPointDifferently) {
  double least = 1, most = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const double x = AxisWarp(seed, 1, 0)(0.3);
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_GT(most - least, 0.01); // ten elementary intervals of a thousand points
}

TEST(AxisWarp, PointsStayInsideTheCube) {
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const double u : {0x1p-1022, 0x1p-53, 1 - 0x1p-53}) {
      const double x = AxisWarp(seed, 1, 0)(u);
      EXPECT_GT(x, 0);
      EXPECT_LT(x, 1);
    }
}

// The mean over the Jacobians: a constant stays constant, a linear function of one variable has its exact mean up to
// the error of the points.
TEST(AxisWarp, MeansAreRelativeToTheJacobians) {
  const std::function<double(std::span<const double>)> constant = [](std::span<const double>) { return 7.0; };
  const std::function<double(std::span<const double>)> linear = [](std::span<const double> u) { return u[0]; };
  const mc::IntegrateOptions o;
  for (const auto* f : {&constant, &linear}) {
    mc::detail::Run run{{{.one = f}, 1, 3, o}};
    for (const Sums& s : run.evaluator.evaluate(run.sobol_sets(Stream::rqmc, 0, 0, 4), 0, 4096)) {
      EXPECT_NE(s.jacobians, 4096);
      EXPECT_NEAR(s.jacobians, 4096, 1);
      EXPECT_NEAR(s.mean(0), f == &constant ? 7 : 0.5, f == &constant ? 1e-14 : 1e-5);
    }
  }
}

// Jumps near ends of elementary intervals, beside a smooth part: without the maps the test fails for each of them. At a
// coverage of 95 %, more than 8 of 50 misses have probability .08 %.
TEST(AxisWarp, IntervalsHoldForJumpsBesideASmoothPart) {
  struct Case {
    double at, sum, product; // factors of jump and of jump times smooth part
  };
  for (const mc::Method method : {mc::Method::rqmc, mc::Method::automatic})
    for (const Case& c :
         {Case{0.3164, 0.2, 0}, Case{0.3945, 0.2, 0}, Case{0.0313, 3, 0}, Case{0.18751, 6, 0}, Case{0.0234, 0, 100}}) {
      const auto f = [&](std::span<const double> u) {
        return std::exp(u[1]) + (u[0] < c.at ? c.sum + c.product * std::exp(u[1]) : 0.0);
      };
      const double integral = (std::exp(1.0) - 1) * (1 + c.product * c.at) + c.sum * c.at;
      int missed = 0;
      for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        mc::IntegrateOptions o;
        o.method = method;
        o.max_calls = 20'000;
        o.seed = seed;
        const mc::Integral r = mc::integrate_unit(f, 2, o);
        missed += !(r.interval.lo <= integral && integral <= r.interval.hi);
      }
      EXPECT_LE(missed, 8) << name(method) << " jump at " << c.at;
    }
}

} // namespace
