#include <mc/check/fit/expected/estimated_mass.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/interval.h>

#include <gtest/gtest.h>

namespace {

using mc::Pcg;

mc::EstimatedMass mass_of(const mc::Subject& s, const mc::UnitBox& box, std::size_t per_axis, std::uint64_t seed) {
  Pcg random(seed);
  mc::EstimatedMass mass;
  add_box(s, box, per_axis, random, mass);
  return mass;
}

TEST(EstimatedMass, Box_EqualsIntegral) {
  const mc::Subject s = make_subject(
      "plane", mc::Square<double>{}, [](const mc::Vec2<double>& u) { return u; },
      [](const mc::Vec2<double>& p) { return p[0] + p[1]; });
  const mc::EstimatedMass m = mass_of(s, {{0, 0, 0}, {0.5, 1, 1}}, 32, 1);
  EXPECT_NEAR(m.value, 0.375, 5 * std::sqrt(m.worst_case_variance()));
  EXPECT_LE(m.variance, 1e-7);
}

// The deviations of mirrored points from the centre cancel.
TEST(EstimatedMass, LinearDensity_IsExact) {
  const mc::Subject s = make_subject(
      "ramp", mc::Interval<double>(0, 1), [](Pcg& r) { return std::sqrt(r.uniform<double>()); },
      [](double x) { return 2 * x; });
  const mc::EstimatedMass m = mass_of(s, {{0, 0, 0}, {1, 1, 1}}, 4, 7);
  EXPECT_NEAR(m.value, 1, 1e-15);
  EXPECT_LE(m.variance_with_jumps(), 1e-30);
  EXPECT_NEAR(m.largest, 0.4375, 1e-15);
}

// A jump in one of 50 boxes, 2000 runs. Each error is within 5 worst-case standard deviations, which include the mass
// that one box may hide. The mean error is within 5 of its standard deviations.
TEST(EstimatedMass, DensityWithJump_StaysWithinStatedError) {
  double sum = 0, squares = 0;
  const int runs = 2000;
  for (int run = 0; run < runs; ++run) {
    const double at = (run + 0.5) / runs;
    const mc::Subject s = make_subject(
        "jump", mc::Interval<double>(0, 1), [](Pcg& r) { return r.uniform<double>(); },
        [=](double x) { return x < at ? 1.0 : 3.0; });
    const mc::EstimatedMass m = mass_of(s, {{0, 0, 0}, {1, 1, 1}}, 50, static_cast<std::uint64_t>(run));
    const double off = m.value - (3 - 2 * at);
    EXPECT_LE(std::abs(off), 5 * std::sqrt(m.worst_case_variance())) << at;
    sum += off;
    squares += off * off;
  }
  EXPECT_LE(std::abs(sum), 5 * std::sqrt(squares));
}

TEST(LinearFit, JumpOnSlope_HasLargeResidual) {
  Pcg random(3);
  mc::LinearFit fit(2);
  const auto add = [&](double jump) {
    for (int i = 0; i < 8; ++i) {
      const mc::UnitBox box{{i / 8.0, 0, 0}, {(i + 1) / 8.0, 1, 1}};
      for (int k = 0; k < 2; ++k) {
        const mc::Subject::Coordinates v = random_point(box, 2, random), w = mirrored(v, box, 2);
        const auto density = [&](const mc::Subject::Coordinates& x) {
          return 1 + 2 * x[0] - 0.5 * x[1] + (i == 3 && x[1] > 0.5 ? jump : 0.0);
        };
        fit.add(v, density(v), 1.0 / 32);
        fit.add(w, density(w), 1.0 / 32);
      }
    }
    return fit.largest_residual();
  };
  EXPECT_LE(add(0), 1e-6);
  EXPECT_GE(add(1), 0.25 / 8);
  EXPECT_LE(add(0), 1e-6); // the fit was reset
}

// Sixteen times the mean square that a jump at a random position hides from n random points.
TEST(EstimatedMass, HiddenJumpVariance_IsScaledBySixteen) {
  for (const double n : {4.0, 12.0, 40.0}) {
    double mean = 0;
    constexpr int steps = 100'000;
    for (int i = 0; i < steps; ++i) {
      const double f = (i + 0.5) / steps;
      mean += f * f * std::pow(1 - f, n) / steps;
    }
    EXPECT_NEAR(mc::hidden_jump_variance(n), 16 * mean, 1e-8 * mean + 1e-12) << n;
  }
  EXPECT_EQ(mc::hidden_jump_variance(0), 1);
}

} // namespace
