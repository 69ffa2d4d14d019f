#include <render/shape/sphere_crossings.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// Both crossings lie on the sphere for any length of d. Eight spheres at a time give the same results as one.
TEST(SphereCrossings, LieOnTheSphere) {
  mc::Pcg random(3);
  int crossed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3d o = 4 * random.point<double, 3>() - Vec3d::Constant(2);
    const double length = std::exp(20 * random.uniform<double>() - 10);
    const Line line(o, length * (random.point<double, 3>() - Vec3d::Constant(0.5)));
    const auto pass = sphere_quadratic(o.x(), o.y(), o.z(), line, 1.0);
    const EightDoubles zero = {}, x = zero + o.x(), y = zero + o.y(), z = zero + o.z(), r2 = zero + 1.0;
    const auto passes = sphere_quadratic(x, y, z, line, r2);
    ASSERT_EQ(pass.discriminant, passes.discriminant[5]);
    ASSERT_EQ(pass.crosses_ahead(), passes.crosses_ahead()[5] != 0);
    if (!pass.crosses()) continue;
    ++crossed;
    const auto one = sphere_crossings(pass, line);
    const auto eight = sphere_crossings(passes, line);
    EXPECT_EQ(one.t0, eight.t0[5]);
    EXPECT_EQ(one.t1, eight.t1[5]);
    EXPECT_LE(one.t0, one.t1);
    EXPECT_EQ(pass.crosses_ahead(), one.t1 > 0);
    // The root loses digits for lines that are nearly tangent.
    const double tolerance = 1e-14 / std::sqrt(std::max(pass.discriminant, 1e-14));
    for (const double t : {one.t0, one.t1}) EXPECT_NEAR((o + t * line.d).norm(), 1, tolerance) << trial;
  }
  EXPECT_GE(crossed, 400);
}

// For a line from the surface inward, one crossing is the start of the line. Far away nothing cancels.
TEST(SphereCrossings, AtTheEdges) {
  const auto along_x = [](double x, double d, double radius) {
    const Line line({x, 0, 0}, {d, 0, 0});
    return sphere_crossings(sphere_quadratic(x, 0.0, 0.0, line, radius * radius), line);
  };
  EXPECT_EQ(along_x(1, -1, 1).t0, 0);
  EXPECT_EQ(along_x(1, -1, 1).t1, 2);
  EXPECT_NEAR(1e8 - 2 * along_x(1e8, -2, 1e-3).t0, 1e-3, 2e-8);
  EXPECT_FALSE(sphere_quadratic(0.0, 2.0, 0.0, Line({0, 2, 0}, {1, 0, 0}), 1.0).crosses());
}

} // namespace
