#include <mc/estimate/integrate/axis_warp.h>
#include <mc/estimate/integrate/evaluate.h>
#include <mc/estimate/integrate/run.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace mc::detail;

TEST(AxisWarp, JacobianIsTheSlopeOfTheMap) {
  constexpr double step = 1e-6;
  const AxisWarp warp(5, 3);
  for (const double u : {0.01, 0.3, 0.77}) {
    double product = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      std::vector<double> a(3, u), b(3, u), jacobian(1);
      a[d] -= step;
      b[d] += step;
      warp.apply(a, jacobian);
      warp.apply(b, jacobian);
      product *= (b[d] - a[d]) / (2 * step);
    }
    std::vector<double> x(3, u), jacobian(1);
    warp.apply(x, jacobian);
    EXPECT_NEAR(jacobian[0], product, 1e-9) << u;
  }
}

TEST(AxisWarp, ReplicatesMoveAPointDifferently) {
  double least = 1, most = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    std::vector<double> x{0.3}, jacobian(1);
    AxisWarp(seed, 1).apply(x, jacobian);
    least = std::min(least, x[0]);
    most = std::max(most, x[0]);
  }
  EXPECT_GT(most - least, 0.01); // ten elementary intervals of a thousand points
}

TEST(AxisWarp, PointsStayInsideTheCube) {
  const double ends[] = {0x1p-1022, 0x1p-53, 1 - 0x1p-53};
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const double u : ends) {
      std::vector<double> x{u}, jacobian(1);
      AxisWarp(seed, 1).apply(x, jacobian);
      EXPECT_GT(x[0], 0);
      EXPECT_LT(x[0], 1);
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
    for (const Sums& s : run.evaluator.evaluate(run.sobol_sets(Stream::rqmc, 0, 0, 4), 0, 4096, {.warps_axes = true})) {
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
