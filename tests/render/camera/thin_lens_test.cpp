#include <render/camera/thin_lens.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace render;

const double half_fov = 2 * std::atan(0.5) * 180 / mc::pi<double>;

/// A camera at `origin` that looks along -z.
ThinLens facing(const LensOptions& options, const Vec3d& origin = Vec3d::Zero()) {
  return ThinLens(Transform::look_at(origin, origin - Vec3d::UnitZ(), Vec3d::UnitY()), options);
}

TEST(ThinLens, PinholeSpansItsFieldOfView) {
  const ThinLens camera = facing({.fov_axis = FovAxis::y, .fov = half_fov});
  const Vec2 tangent = camera.tan_half(2);
  EXPECT_LE((tangent - Vec2(1, Float(0.5))).norm(), 1e-6);
  const auto through = [&](Float x, Float y) { return camera.ray(Vec2(x, y), tangent, Vec2::Zero()); };
  EXPECT_LE((through(Float(0.5), Float(0.5)).d - camera.forward()).norm(), 1e-7);
  // The top left corner is to the left and up.
  EXPECT_LE((through(0, 0).d - Vec3(-1, Float(0.5), -1).normalized()).norm(), 1e-6);
  EXPECT_LE((through(1, 1).d - Vec3(1, Float(-0.5), -1).normalized()).norm(), 1e-6);
  EXPECT_EQ(through(1, 1).o, camera.origin());
}

// sample_wi() of a point on a ray returns the ray's film point, and the density of its place is 1 over the film's area.
TEST(ThinLens, ParallelRaysSpanTheFilm) {
  const ThinLens camera = facing({.near = 0.5, .far = 9, .half_width = 3}, Vec3d(1, 2, 3));
  const Vec2 half = camera.tan_half(Float(1.5));
  EXPECT_LE((half - Vec2(3, 2)).norm(), 1e-6);
  EXPECT_LE((camera.ray(Vec2(0, 0), half, Vec2::Zero()).o - Vec3(-2, 4, Float(2.5))).norm(), 1e-6);
  mc::Pcg random(7);
  for (int i = 0; i < 100; ++i) {
    const Vec2 s = random.point<Float, 2>();
    const Ray ray = camera.ray(s, half, Vec2::Zero());
    EXPECT_EQ(ray.d, camera.forward());
    EXPECT_EQ(ray.t_max, Float(8.5));
    const Float t = Float(8) * random.uniform<Float>();
    const auto seen = camera.sample_wi(ray.at(t), half, Vec2::Zero());
    ASSERT_TRUE(seen);
    EXPECT_LE((seen->s - s).norm(), 1e-6);
    EXPECT_EQ(seen->wi, -camera.forward());
    EXPECT_NEAR(seen->t_max, t, 1e-5);
    EXPECT_NEAR(seen->direction_pdf, 1.0 / 24, 1e-7);
    EXPECT_EQ(camera.spread(double(seen->distance)), 1);
  }
  EXPECT_FALSE(camera.sample_wi(Vec3(1, 2, Float(2.6)), half, Vec2::Zero()));
  EXPECT_THROW(facing({.radius = 1, .half_width = 1}), mc::Error);
  EXPECT_THROW(facing({.half_width = -1}), mc::Error);
}

TEST(ThinLens, TheFieldOfViewHasAnAxis) {
  using Axis = FovAxis;
  struct Row {
    Axis axis;
    Float aspect, x, y;
  };
  for (const Row& row : {Row{Axis::x, 2, 1, Float(0.5)},
                         {Axis::y, 2, 2, 1},
                         {Axis::smaller, 2, 2, 1},
                         {Axis::larger, 2, 1, Float(0.5)},
                         {Axis::smaller, Float(0.5), 1, 2},
                         {Axis::larger, Float(0.5), Float(0.5), 1},
                         {Axis::diagonal, Float(0.75), Float(0.6), Float(0.8)}}) {
    const ThinLens camera = facing({.fov_axis = row.axis});
    EXPECT_LE((camera.tan_half(row.aspect) - Vec2(row.x, row.y)).norm(), 1e-6) << int(row.axis) << " at " << row.aspect;
  }
}

// sample_wi() of a point on a camera ray returns the ray's film point and direction. The density of the direction is 1
// over the film's area at distance 1 and over the cube of the cosine.
TEST(ThinLens, SeesWhatItsRaysReach) {
  mc::Pcg random(11);
  for (int i = 0; i < 200; ++i) {
    LensOptions options{.fov = 20 + 100 * random.uniform<double>(),
                        .radius = i % 2 ? 0.3 * random.uniform<double>() : 0,
                        .focus_distance = 0.5 + 5 * random.uniform<double>(),
                        .near = i % 3 ? 0.1 : 0,
                        .far = i % 5 ? 50 : mc::infinity<double>};
    const ThinLens camera = facing(options, Vec3d(1, 2, 3));
    const Vec2 tangent = camera.tan_half(Float(1.5)), u = random.point<Float, 2>();
    const Vec2 s = 2 * random.point<Float, 2>() - Vec2::Constant(Float(0.5)); // outside the film, too
    const Ray ray = camera.ray(s, tangent, u);
    const Float t = 1 + 3 * random.uniform<Float>();
    const auto seen = camera.sample_wi(ray.at(t), tangent, u);
    ASSERT_TRUE(seen) << i;
    EXPECT_LE((seen->s - s).norm(), 1e-4) << i;
    EXPECT_LE((seen->wi + ray.d).norm(), 1e-5) << i;
    EXPECT_NEAR(seen->t_max, t, 1e-4) << i;
    const double cosine = double(ray.d.dot(camera.forward()));
    EXPECT_NEAR(seen->distance - seen->t_max, options.near / cosine, 1e-4) << i;
    const double density = 1 / (4 * double(tangent.prod()) * cosine * cosine * cosine);
    EXPECT_NEAR(seen->direction_pdf / density, 1, 1e-4) << i;
    EXPECT_NEAR(camera.direction_pdf(ray.d, tangent) / density, 1, 1e-4) << i;
    EXPECT_FALSE(camera.sample_wi(camera.origin() - camera.forward(), tangent, u)) << i;
    EXPECT_EQ(camera.sample_wi(camera.origin() + 51 * camera.forward(), tangent, u).has_value(), i % 5 == 0) << i;
    EXPECT_EQ(camera.sample_wi(camera.origin() + Float(0.09) * camera.forward(), tangent, u).has_value(), i % 3 == 0)
        << i;
  }
}

// Rays from all film points end in the far plane.
TEST(ThinLens, NearAndFarPlanesCutRays) {
  for (const double radius : {0.0, 0.3}) {
    const ThinLens camera = facing({.radius = radius, .near = 2, .far = 7}, {1, 2, 3});
    for (const Vec2& s : {Vec2(0, 0), Vec2(Float(0.5), Float(0.2)), Vec2(1, 1)}) {
      const Ray ray = camera.ray(s, camera.tan_half(1), Vec2(Float(0.3), Float(0.9)));
      EXPECT_NEAR(ray.o.z(), 1, 1e-5);
      EXPECT_NEAR(ray.at(ray.t_max).z(), -4, 1e-5);
    }
  }
  EXPECT_THROW(facing({.near = 2, .far = 2}), mc::Error);
  EXPECT_EQ(facing({}).ray(Vec2(0, 0), Vec2(1, 1), Vec2(0, 0)).t_max, mc::infinity<Float>);
}

TEST(ThinLens, RaysOfOneFilmPointMeetInTheFocalPlane) {
  const ThinLens camera = facing({.radius = 0.3, .focus_distance = 5}, {1, 2, 3});
  const Vec2 s(Float(0.2), Float(0.7)), tangent = camera.tan_half(1);
  const Vec3 focus = camera.origin() + 5 * Vec3(2 * s[0] - 1, 1 - 2 * s[1], -1);
  double second_moment = 0;
  const int n = 64;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Ray ray = camera.ray(s, tangent, Vec2((Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n));
      EXPECT_LE((ray.at((focus - ray.o).dot(ray.d)) - focus).norm(), 1e-5);
      EXPECT_NEAR(ray.d.norm(), 1, 1e-6);
      second_moment += double((ray.o - camera.origin()).squaredNorm()) / (n * n);
    }
  // Uniform on the lens: E[r^2] = R^2 / 2. A radius linear in u gives R^2 / 3 (course Introduction to Real-Time Ray
  // Tracing, SIGGRAPH 2019, tutorial 8).
  EXPECT_NEAR(second_moment / 0.09, 0.5, 1e-3);
}

TEST(ThinLens, NearCutsByAPlane) {
  const ThinLens camera = facing({.near = 2});
  for (const Float x : {Float(0), Float(0.5), Float(1)})
    EXPECT_NEAR((camera.ray(Vec2(x, x), camera.tan_half(1), Vec2::Zero()).o - camera.origin()).dot(camera.forward()), 2,
                1e-6);
}

TEST(ThinLens, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LensOptions& bad : {LensOptions{.fov = 0},
                                 {.fov = 180},
                                 {.fov = nan},
                                 {.radius = -1},
                                 {.radius = nan},
                                 {.focus_distance = 0},
                                 {.focus_distance = mc::infinity<double>},
                                 {.near = -1}})
    EXPECT_THROW(ThinLens({}, bad), mc::Error);
  EXPECT_THROW(ThinLens(Transform::scale({1, 0, 1})), mc::Error);
}

// Other frames are rejected. The tolerance allows for files with about six digits.
TEST(ThinLens, TakesAFrameOfEqualOrthogonalAxesOnly) {
  const Transform turned = Transform::rotate({1, 2, 3}, 50);
  for (const Vec3d& fine :
       {Vec3d(1, 1, 1), Vec3d(-1, 1, 1), Vec3d(250, -250, 250), Vec3d(1e-6, 1e-6, 1e-6), Vec3d(1, 1.00005, 1)})
    EXPECT_NO_THROW(ThinLens(turned * Transform::scale(fine))) << fine;
  for (const Vec3d& bent : {Vec3d(1, 2, 1), Vec3d(1, 1, 0.5), Vec3d(1.0003, 1, 1), Vec3d(1e300, 1, 1)}) {
    EXPECT_THROW(ThinLens(turned * Transform::scale(bent)), mc::Error) << bent;
    EXPECT_THROW(ThinLens(Transform::scale(bent) * turned), mc::Error) << bent; // sheared, too
  }
  EXPECT_THROW(ThinLens(Transform::columns({1, 0, 0}, {0.3, std::sqrt(0.91), 0}, {0, 0, 1}, {0, 0, 0})), mc::Error);
}

} // namespace
