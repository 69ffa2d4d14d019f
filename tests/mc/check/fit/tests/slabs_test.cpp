#include <mc/check/fit/tests/slabs.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/interval.h>
#include <mc/warp/spherical_triangle.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

using Kind = mc::Slab::Kind;

// The slabs of 20000 samples on [0,1] that claim to be uniform.
template <class Sampler> std::vector<mc::Slab> slabs(Sampler sampler) {
  const mc::Subject s = make_subject("slabs", mc::Interval<double>(0, 1), sampler, [](double) { return 1.0; });
  const mc::Pilot pilot = draw_pilot(s, 5, 160'000);
  return find_slabs(s, pilot, pilot.sorted);
}

TEST(Slabs, UniformSamplesAreNotSuspect) {
  EXPECT_TRUE(slabs([](mc::Pcg& r) { return r.uniform<double>(); }).empty());
}

TEST(Slabs, AClampIsAnAtom) {
  const auto found = slabs([](mc::Pcg& r) { return std::max(r.uniform<double>(), 1e-3); });
  const auto atom = std::find_if(found.begin(), found.end(), [](const mc::Slab& s) { return s.kind == Kind::atom; });
  ASSERT_NE(atom, found.end());
  EXPECT_LE(atom->box.lo[0], 1e-3);
  EXPECT_GE(atom->box.hi[0], 1e-3);
  EXPECT_LE(atom->mass.value, 1e-12);
  EXPECT_GE(atom->count, 8); // 20 expected; fewer than 8 once in 1000 seeds
}

// Holes of 0.004, each 80 spacings wide.
TEST(Slabs, HolesAreGapsInsideAndAtBothEnds) {
  const auto found = slabs([](mc::Pcg& r) {
    for (;;) {
      const double x = r.uniform<double>();
      if (x > 0.004 && !(x > 0.5 && x < 0.504) && x < 0.996) return x;
    }
  });
  std::vector<double> middles;
  for (const mc::Slab& s : found) {
    EXPECT_EQ(s.kind, Kind::gap);
    EXPECT_NEAR(s.mass.value, 0.004, 5e-4);
    EXPECT_EQ(s.count, 0);
    middles.push_back((s.box.lo[0] + s.box.hi[0]) / 2);
  }
  EXPECT_THAT(middles, testing::ElementsAre(testing::DoubleNear(0.002, 1e-3), testing::DoubleNear(0.502, 1e-3),
                                            testing::DoubleNear(0.998, 1e-3)));
}

// A triangle of 1e-4 seen in float: its points are rounded to steps of 1e-3 of its chart, and some lie just outside.
TEST(Slabs, RoundingIsNoGap) {
  const mc::SphericalTriangle<float> triangle(mc::Vec3<float>(0.3f, -0.2f, 0.9f), mc::Vec3<float>(1e-4f, 1e-5f, -2e-5f),
                                              mc::Vec3<float>(3e-5f, 1e-4f, 5e-6f));
  const mc::Subject s = make_subject("tiny triangle", triangle);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const mc::Pilot pilot = draw_pilot(s, seed, 800'000);
    for (const mc::Slab& slab : find_slabs(s, pilot, pilot.sorted))
      EXPECT_NE(slab.kind, Kind::gap) << slab.box.lo[slab.axis] << " to " << slab.box.hi[slab.axis];
  }
}

} // namespace
