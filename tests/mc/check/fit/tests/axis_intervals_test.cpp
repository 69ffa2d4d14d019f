#include <mc/check/fit/tests/axis_intervals.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/interval.h>
#include <mc/warp/spherical_triangle.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

using IntervalKind = mc::AxisInterval::Kind;

// Returns the intervals of 20000 samples on [0,1] that claim to be uniform.
template <class Sampler> std::vector<mc::AxisInterval> intervals(Sampler sampler) {
  const mc::Subject s = make_subject("slabs", mc::Interval<double>(0, 1), sampler, [](double) { return 1.0; });
  const mc::Pilot pilot = draw_pilot(s, 5, 160'000);
  return find_axis_intervals(s, pilot, pilot.sorted);
}

TEST(AxisIntervals, UniformSamples_HaveNoAtomsOrGaps) {
  EXPECT_TRUE(intervals([](mc::Pcg& r) { return r.uniform<double>(); }).empty());
}

TEST(AxisIntervals, ClampedCoordinate_IsAtom) {
  const auto found = intervals([](mc::Pcg& r) { return std::max(r.uniform<double>(), 1e-3); });
  const auto atom =
      std::find_if(found.begin(), found.end(), [](const mc::AxisInterval& s) { return s.kind == IntervalKind::atom; });
  ASSERT_NE(atom, found.end());
  EXPECT_LE(atom->box.lo[0], 1e-3);
  EXPECT_GE(atom->box.hi[0], 1e-3);
  EXPECT_LE(atom->mass.value, 1e-12);
  EXPECT_GE(atom->count, 8); // 20 expected; fewer than 8 with probability 0.001
}

// Returns the verdict on the atoms of n exponential samples from random numbers of `bits` bits, clamped at `limit`.
mc::Verdict atoms(std::uint64_t seed, std::uint64_t n, int bits, double limit) {
  const mc::Subject s = make_subject(
      "exponential", mc::HalfLine<double>(0, 1),
      [=](mc::Pcg& r) { return std::min(-std::log(1 - std::ldexp(double(r.next64() >> (64 - bits)), -bits)), limit); },
      [](double x) { return std::exp(-x); });
  const mc::Pilot pilot = draw_pilot(s, seed, 8 * n);
  return test_axis_intervals(s, IntervalKind::atom, find_axis_intervals(s, pilot, pilot.sorted), static_cast<double>(n),
                             1, 0.03, 0.01)
      .verdict;
}

// Four of 50000 samples are expected above the limit: two or more with probability 0.91. Fewer than 97 of 120 runs have
// two or more with probability 2e-4.
TEST(AxisIntervals, EqualPairAtEnd_IsAtom) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed)
    found += atoms(seed, 50'000, 53, std::log(50'000 / 4.0)) == mc::Verdict::fail;
  EXPECT_GE(found, 97);
}

// One pair of 1e5 samples of 32 bits is equal on average. The test spends 3e-4.
TEST(AxisIntervals, FewRandomBits_AreNoAtom) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (const int bits : {32, 53})
      EXPECT_EQ(atoms(seed, 100'000, bits, HUGE_VAL), mc::Verdict::pass) << seed << ", " << bits;
}

// All samples lie within a few steps of the scalar: the interval contains the lobe, and its claimed mass is the mass of
// the lobe.
TEST(AxisIntervals, LobeThinnerThanInterval_IsNoAtom) {
  for (const float width : {1e-7f, 2e-7f, 5e-7f})
    for (const float decay : {1e-2f, 1e-4f, 1e-6f}) {
      const float lo = 0.3f, hi = lo + width;
      const mc::Subject s = make_subject(
          "lobe", mc::Box<float, 2>({0, 0}, {1, 1}),
          [=](const mc::Vec2<float>& u) {
            return mc::Vec2<float>(static_cast<float>(lo + double{hi - lo} * double{u[0]}),
                                   std::min(-decay * std::log1p(-u[1]), 1.f));
          },
          [=](const mc::Vec2<float>& x) {
            return x[0] >= lo && x[0] <= hi ? std::exp(-x[1] / decay) / decay / (hi - lo) : 0.f;
          });
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const mc::Pilot pilot = draw_pilot(s, seed, 160'000);
        const mc::Check c = test_axis_intervals(s, IntervalKind::atom, find_axis_intervals(s, pilot, pilot.sorted),
                                                20'000, 1, 0.03, 0.01);
        EXPECT_EQ(c.verdict, mc::Verdict::pass) << width << ", " << decay << ", seed " << seed << ": p = " << *c.p;
      }
    }
}

// Holes of width 0.004, each 80 spacings wide.
TEST(AxisIntervals, HolesInsideAndAtEnds_AreGaps) {
  const auto found = intervals([](mc::Pcg& r) {
    for (;;) {
      const double x = r.uniform<double>();
      if (x > 0.004 && !(x > 0.5 && x < 0.504) && x < 0.996) return x;
    }
  });
  std::vector<double> middles;
  for (const mc::AxisInterval& s : found) {
    EXPECT_EQ(s.kind, IntervalKind::gap);
    EXPECT_NEAR(s.mass.value, 0.004, 5e-4);
    EXPECT_EQ(s.count, 0);
    middles.push_back((s.box.lo[0] + s.box.hi[0]) / 2);
  }
  EXPECT_THAT(middles, testing::ElementsAre(testing::DoubleNear(0.002, 1e-3), testing::DoubleNear(0.502, 1e-3),
                                            testing::DoubleNear(0.998, 1e-3)));
}

// A triangle of size 1e-4 in float: its points are rounded to steps of 1e-3 in the chart, and some lie just outside.
TEST(AxisIntervals, RoundedCoordinates_AreNoGap) {
  const mc::SphericalTriangle<float> triangle(mc::Vec3<float>(0.3f, -0.2f, 0.9f), mc::Vec3<float>(1e-4f, 1e-5f, -2e-5f),
                                              mc::Vec3<float>(3e-5f, 1e-4f, 5e-6f));
  const mc::Subject s = make_subject("tiny triangle", triangle);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const mc::Pilot pilot = draw_pilot(s, seed, 800'000);
    for (const mc::AxisInterval& interval : find_axis_intervals(s, pilot, pilot.sorted))
      EXPECT_NE(interval.kind, IntervalKind::gap)
          << interval.box.lo[interval.axis] << " to " << interval.box.hi[interval.axis];
  }
}

} // namespace
