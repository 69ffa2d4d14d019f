#include <mc/domain/patch.h>

#include <gtest/gtest.h>

namespace mc {
namespace {

template <class D> void expect_chart_inverts(const D& patch) {
  const Vec2<double> v(0.3, 0.8);
  const Vec3<double> w = patch.from_unit(v);
  EXPECT_TRUE(patch.contains(w));
  EXPECT_FALSE(patch.contains(-w));
  EXPECT_LE((patch.to_unit(w) - v).norm(), 1e-14);
}

TEST(Patch, ChartsInvert) {
  expect_chart_inverts(TrianglePatch<double>({0.1, 0.2, 1}, {1, 0, 0.2}, {0, 1, 0}));
  expect_chart_inverts(ParallelogramPatch<double>({0.1, 0.2, 1}, {1, 0, 0.2}, {0, -1, 0}));
}

TEST(Patch, RefusesEdgeOn) { EXPECT_THROW((TrianglePatch<double>({1, 0, 0}, {1, 0, 0}, {0, 1, 0})), Error); }

} // namespace
} // namespace mc
