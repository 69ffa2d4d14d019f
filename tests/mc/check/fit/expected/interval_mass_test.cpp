#include <mc/check/fit/expected/interval_mass.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>

#include <gtest/gtest.h>

#include <functional>

namespace {

using mc::Pcg, mc::sqr, mc::Vec2;

// Uses the pilot points inside, at least the 64 nearest to the centre.
mc::IntervalQuery query(const mc::Pilot& pilot, double lo, double hi, double mass) {
  const double inside = (pilot.rank(1, hi) - pilot.rank(1, lo)) * static_cast<double>(pilot.points.size());
  return {1, lo, hi, pilot.nearest(1, 0.5 * (lo + hi), std::max<std::size_t>(64, std::llround(inside))), mass};
}

// A uniform square with nine tenths of the samples on a ridge of width 1/2000 across it.
mc::Subject ridge(double slope, double at) {
  constexpr double width = 1.0 / 2000, share = 0.9;
  const auto moved = [](double x) { return x - std::floor(x); };
  return make_subject(
      "ridge", mc::Square<double>{},
      [=](Pcg& r) {
        const double y = r.uniform<double>(), x = r.uniform<double>();
        const double beside = r.uniform<double>() < share ? width * x : x;
        return Vec2<double>(std::min(moved(beside + at + slope * y), 1 - 0x1p-53), y);
      },
      [=](const Vec2<double>& p) { return 1 - share + (moved(p[0] - at - slope * p[1]) < width ? share / width : 0); });
}

// Layers with ten to ten thousand of 1e5 samples, for 400 random ridges. Every error is within five stated standard
// deviations.
TEST(IntervalMass, StatedErrorCoversMissedMass) {
  Pcg random(2);
  for (int i = 0; i < 400; ++i) {
    const mc::Subject s = ridge(4 * random.uniform<double>() - 2, random.uniform<double>());
    const mc::Pilot pilot = draw_pilot(s, random.next64(), 100'000);
    const double thick = std::pow(10.0, -4 + 3 * random.uniform<double>());
    const double lo = i % 4 == 0 ? 0.0 : (1 - thick) * random.uniform<double>();
    for (const mc::Effort effort : {mc::Effort::quick, mc::Effort::full}) {
      const mc::EstimatedMass m = interval_mass(s, pilot, query(pilot, lo, lo + thick, thick), random.next64(), effort);
      EXPECT_NEAR(m.value, thick, 5 * std::sqrt(m.worst_case_variance())) << i << ": from " << lo << ", " << thick;
    }
  }
}

// For a smooth density the standard deviation is at most a fiftieth of the mass, a tenth of the noise of 25 samples.
TEST(IntervalMass, SmoothDensity_HasSmallError) {
  const mc::Subject s = make_subject(
      "powers", mc::Square<double>{}, [](const Vec2<double>& u) { return Vec2<double>(sqr(u[0]), std::cbrt(u[1])); },
      [](const Vec2<double>& p) { return 1.5 * sqr(p[1]) / std::sqrt(p[0]); });
  const mc::Pilot pilot = draw_pilot(s, 1, 100'000);
  for (const double lo : {0.0, 0.3, 0.7, 0.999}) {
    const double hi = lo + 1e-3, mass = hi * hi * hi - lo * lo * lo;
    const mc::EstimatedMass m = interval_mass(s, pilot, query(pilot, lo, hi, mass), 3);
    EXPECT_NEAR(m.value, mass, 5 * std::sqrt(m.worst_case_variance())) << lo;
    EXPECT_LE(std::sqrt(m.worst_case_variance()), 0.02 * mass) << lo;
  }
}

TEST(DescribeInterval, NamesPointOfDomain) {
  mc::Subject s;
  s.dim = 2;
  s.axes = {{"quantile of x"}, {"y"}};
  EXPECT_EQ(describe_interval(s, 0, 0.25, 0.5), "quantile of x in [0.25, 0.5]");
  s.describe_point = [](const mc::Subject::Coordinates& v) { return "x = " + std::to_string(10 * v[0]); };
  EXPECT_EQ(describe_interval(s, 0, 0.25, 0.5), "quantile of x in [0.25, 0.5], for example about x = 3.750000,");
}

} // namespace
