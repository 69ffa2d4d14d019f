#include <render/shape/cylinder_crossings.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace render;

// Both crossings lie on the cylinder, and a line meets it if it passes the axis within the radius. Origins are up to
// 1e6 radii away.
TEST(CylinderCrossings, LieOnTheCylinder) {
  mc::Pcg random(5);
  int met = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double away = std::pow(10, 6 * random.uniform<double>()),
                 turn = 2 * mc::pi<double> * random.uniform<double>();
    const double miss = 2 * random.uniform<double>(); // distance of the line from the axis
    const mc::Vec2<double> d(std::cos(turn), std::sin(turn)), aside(-d.y(), d.x());
    const mc::Vec2<double> o = miss * aside - away * d;
    const auto at = cylinder_crossings<double>(o.x(), o.y(), 3, d.x(), d.y(), 0.5, 1);
    if (std::abs(miss - 1) < 1e-8) continue;
    ASSERT_EQ(bool(at.crosses), miss < 1) << miss << " " << away;
    if (!at.crosses) continue;
    ++met;
    const double half = std::sqrt(1 - miss * miss), error = 1e-15 * away / half + 1e-15;
    EXPECT_NEAR(at.t0, away - half, 8 * error) << miss << " " << away;
    EXPECT_NEAR(at.t1, away + half, 8 * error) << miss << " " << away;
    EXPECT_EQ(at.z0, 3 + at.t0 * 0.5);
    EXPECT_EQ(at.z1, 3 + at.t1 * 0.5);
  }
  EXPECT_GT(met, 4000);
}

TEST(CylinderCrossings, ALineAlongTheAxisHasNone) {
  for (const double x : {0.0, 0.5, 1.0, 2.0}) {
    const auto at = cylinder_crossings<double>(x, 0, -1, 0, 0, 1, 1);
    EXPECT_TRUE(!at.crosses || std::isnan(at.t0) || std::isinf(at.t0)) << x << " " << at.t0;
    EXPECT_TRUE(!at.crosses || std::isnan(at.t1) || std::isinf(at.t1)) << x << " " << at.t1;
  }
}

} // namespace
