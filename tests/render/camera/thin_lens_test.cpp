#include <render/camera/thin_lens.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(ThinLens, PinholeSpansItsFieldOfView) {
  ThinLens camera;
  camera.tan_half_fov = Float(0.5);
  const Vec2 tangent = camera.tan_half(2);
  EXPECT_EQ(tangent, Vec2(1, Float(0.5)));
  const auto through = [&](Float x, Float y) { return camera.ray(Vec2(x, y), tangent, Vec2::Zero()); };
  EXPECT_LE((through(Float(0.5), Float(0.5)).d - camera.forward).norm(), 1e-7);
  // Top left: to the left and up.
  EXPECT_LE((through(0, 0).d - Vec3(-1, Float(0.5), -1).normalized()).norm(), 1e-6);
  EXPECT_LE((through(1, 1).d - Vec3(1, Float(-0.5), -1).normalized()).norm(), 1e-6);
  EXPECT_EQ(through(1, 1).o, camera.origin);
}

TEST(ThinLens, TheFieldOfViewHasAnAxis) {
  ThinLens camera;
  using Axis = ThinLens::FovAxis;
  struct Row {
    Axis axis;
    Float aspect, x, y;
  };
  for (const Row& row : {Row{Axis::x, 2, 1, Float(0.5)},
                         {Axis::y, 2, 2, 1},
                         {Axis::smaller, 2, 2, 1},
                         {Axis::larger, 2, 1, Float(0.5)},
                         {Axis::smaller, Float(0.5), 1, 2},
                         {Axis::larger, Float(0.5), Float(0.5), 1}}) {
    camera.fov_axis = row.axis;
    EXPECT_EQ(camera.tan_half(row.aspect), Vec2(row.x, row.y)) << int(row.axis) << " at " << row.aspect;
  }
}

TEST(ThinLens, RaysOfOneFilmPointMeetInTheFocalPlane) {
  ThinLens camera;
  camera.origin = Vec3(1, 2, 3);
  camera.lens_radius = Float(0.3), camera.focus_distance = 5;
  const Vec2 s(Float(0.2), Float(0.7)), tangent = camera.tan_half(1);
  const Vec3 focus = camera.origin + 5 * Vec3(2 * s[0] - 1, 1 - 2 * s[1], -1);
  double second_moment = 0;
  const int n = 64;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Ray ray = camera.ray(s, tangent, Vec2((Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n));
      EXPECT_LE((ray.at((focus - ray.o).dot(ray.d)) - focus).norm(), 1e-5);
      EXPECT_NEAR(ray.d.norm(), 1, 1e-6);
      second_moment += double((ray.o - camera.origin).squaredNorm()) / (n * n);
    }
  // Uniform on the lens: E[r^2] = R^2 / 2; a radius linear in u gives R^2 / 3 (seed-slips P15).
  EXPECT_NEAR(second_moment / 0.09, 0.5, 1e-3);
}

TEST(ThinLens, NearCutsByAPlane) {
  ThinLens camera;
  camera.near = 2;
  for (const Float x : {Float(0), Float(0.5), Float(1)})
    EXPECT_NEAR((camera.ray(Vec2(x, x), camera.tan_half(1), Vec2::Zero()).o - camera.origin).dot(camera.forward), 2,
                1e-6);
}

} // namespace
