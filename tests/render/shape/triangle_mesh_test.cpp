#include <render/shape/triangle_mesh.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/stats/t_test.h>

#include <Eigen/LU>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Transform scaled_at(const Vec3d& scale, const Vec3d& at) { return Transform::translate(at) * Transform::scale(scale); }

template <class F> std::string message_of(F&& f) {
  try {
    f();
  } catch (const mc::Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(TriangleMesh, RejectsBadDataByNameAndValue) {
  EXPECT_THROW(TriangleMesh(corners, {}), mc::Error);
  EXPECT_THAT(message_of([] {
                TriangleMesh(corners, {{0, 1, 2}, {0, 1, 4}});
              }),
              testing::HasSubstr("triangle 1 names vertex 4"));
  for (const Float bad : {std::numeric_limits<Float>::quiet_NaN(), mc::infinity<Float>}) {
    auto positions = corners;
    positions[2].y() = bad;
    EXPECT_THAT(message_of([&] { TriangleMesh(positions, {{0, 1, 2}}); }), testing::HasSubstr("vertex 2"));
  }
  EXPECT_THROW(TriangleMesh(corners, {{0, 1, 2}}, {Vec3(0, 0, 1)}), mc::Error);
}

TEST(TriangleMesh, Areas) {
  EXPECT_EQ(TriangleMesh::rectangle(scaled_at({65, 52.5, 1}, {278, 554, 279.5})).area(), 13650);
  EXPECT_EQ(TriangleMesh::box(scaled_at({1, 2, 3}, {0, 0, 0})).area(), 8 * (2 + 6 + 3));
  EXPECT_EQ(TriangleMesh(corners, {{0, 1, 1}}).area(), 0);
}

// Compares the mean of 1/pdf on a grid of u with the analytic solid angle of the Cornell light. pdf = d^2 / (cos A).
TEST(TriangleMesh, SolidAngleOfTheCornellLight) {
  // The square in xy, transformed to the plane y = 554.
  const Transform m = Transform::columns({65, 0, 0}, {0, 0, 52.5}, {0, 1, 0}, {278, 554, 279.5});
  const TriangleMesh light = TriangleMesh::rectangle(m);
  const int n = 512;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto s =
          light.sample(Vec3(278, 0, Float(279.5)), Vec2((Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n));
      ASSERT_TRUE(s.has_value());
      sum += 1 / double(s->pdf);
    }
  EXPECT_NEAR(sum / (n * n), 0.043975585816, 1e-7);
}

// A point just below a square light. With area sampling, 1/pdf would be 1e-6 for nearly all samples and 1e6 for a few.
// With solid angle sampling, two triangles share a hemisphere.
TEST(TriangleMesh, LightThatNearlyTouchesIsSampledBySolidAngle) {
  const TriangleMesh light = TriangleMesh::rectangle(scaled_at({1, 1, 1}, {0, 0, 0}));
  const Vec3 ref(Float(0.3), Float(-0.2), Float(-1e-3));
  mc::Pcg random(3);
  mc::Moments solid_angle;
  for (int i = 0; i < 5000; ++i) {
    const auto s = light.sample(ref, random.point<Float, 2>());
    ASSERT_TRUE(s.has_value());
    EXPECT_LE(1 / s->pdf, 4 * mc::pi<Float>);
    EXPECT_EQ(s->pdf, light.pdf(ref, s->wi, s->point));
    solid_angle.add(1 / double(s->pdf), std::uint64_t(i));
  }
  // The expected value is the sum of atan(a b / (h sqrt(a^2 + b^2 + h^2))) over the four rectangles at the foot of the
  // height h. alpha = 1e-4 for one fixed seed.
  EXPECT_GE(mc::t_test(solid_angle, 2 * mc::pi<double> - 0.006153914).p, 1e-4);
}

TEST(TriangleMesh, SampleSaysWhatPdfSaysAndSkipsDegenerateTriangles) {
  const TriangleMesh mesh(corners, {{0, 1, 1}, {1, 2, 3}, {2, 2, 2}, {0, 2, 1}, {3, 3, 0}});
  mc::Pcg random(1);
  for (int i = 0; i < 5000; ++i) {
    Vec2 u = random.point<Float, 2>();
    if (i % 10 == 0) u[i % 20 == 0] = i % 40 < 20 ? Float(0) : mc::one_minus_epsilon<Float>;
    const Vec3 ref = 3 * random.point<Float, 3>() + Vec3::Constant(1);
    const auto s = mesh.sample(ref, u);
    ASSERT_TRUE(s.has_value());
    EXPECT_TRUE(s->point.prim == 1 || s->point.prim == 3) << s->point.prim;
    EXPECT_EQ(s->pdf, mesh.pdf(ref, s->wi, s->point));
    EXPECT_LE((ref + (s->point.p - ref).norm() * s->wi - s->point.p).norm(), 4e-6);
  }
  EXPECT_EQ(TriangleMesh(corners, {{0, 1, 1}}).sample(Vec3(1, 1, 1), Vec2(0, 0)), std::nullopt);
}

// A direction through a box crosses it twice; each crossing has its own density.
TEST(TriangleMesh, DirectionPdfSumsTheCrossings) {
  const TriangleMesh box = TriangleMesh::box(scaled_at({1, 1, 1}, {0, 0, 0}));
  const Vec3 ref(Float(0.1), Float(0.2), 4), wi(0, 0, -1);
  EXPECT_NEAR(double(box.pdf(ref, wi)), (9 + 25) / 24.0, 1e-6);
  EXPECT_EQ(box.pdf(ref, Vec3(0, 0, 1)), 0);
}

// Each side of a box covers [0,1]^2 once and is not mirrored: u, v and the normal are right-handed.
TEST(TriangleMesh, TextureCoordinatesFillTheSidesOfABox) {
  const TriangleMesh box = TriangleMesh::box(scaled_at({1, 2, 3}, {5, 6, 7}));
  ASSERT_TRUE(box.has_uv());
  for (int side = 0; side < 6; ++side) {
    double area = 0;
    for (const int triangle : {2 * side, 2 * side + 1}) {
      const auto at = [&](Float b1, Float b2) { return box.uv({0, 0, triangle, b1, b2}, SurfacePoint()); };
      const auto p = [&](double b1, double b2) {
        return Vec3d(box.point(static_cast<std::size_t>(triangle), b1, b2).p.cast<double>());
      };
      const mc::Vec2<double> du = at(1, 0) - at(0, 0), dv = at(0, 1) - at(0, 0);
      EXPECT_LT(du[0] * dv[1] - du[1] * dv[0], 0) << "mirrored, as Mitsuba's";
      area -= (du[0] * dv[1] - du[1] * dv[0]) / 2;
      EXPECT_GT(mc::cross<double>(p(1, 0) - p(0, 0), p(0, 1) - p(0, 0)).dot(p(0.3, 0.3) - Vec3d(5, 6, 7)), 0);
    }
    EXPECT_EQ(area, 1) << side;
    const double sides[] = {4 * 2 * 3, 4 * 2 * 1, 4 * 3 * 1};
    for (const auto& [b1, b2] : {std::pair(0.2, 0.3), {0.9, 0.05}, {0.0, 1.0}})
      for (const int triangle : {2 * side, 2 * side + 1}) {
        const mc::Vec2<double> by_point = box.uv(box.point(static_cast<std::size_t>(triangle), b1, b2)),
                               by_hit = box.uv({0, 0, triangle, Float(b1), Float(b2)}, SurfacePoint());
        EXPECT_LE((by_point - by_hit).norm(), 1e-5);
      }
    const double scale = box.uv_scale({0, 0, 2 * side}, SurfacePoint());
    EXPECT_TRUE(std::any_of(std::begin(sides), std::end(sides), [&](double a) {
      return std::abs(scale * scale * a - 1) < 1e-5;
    })) << side;
  }
}

TEST(TriangleMesh, NormalsOfBoxesPointOutwardAlsoWhenMirrored) {
  for (const double mirror : {1.0, -1.0}) {
    const TriangleMesh box = TriangleMesh::box(scaled_at({mirror, 2, 3}, {5, 6, 7}));
    for (int i = 0; i < static_cast<int>(box.size()); ++i) {
      const SurfacePoint s = box.point(static_cast<std::size_t>(i), 0.3, 0.3);
      EXPECT_GT(s.ng.dot(s.p - Vec3(5, 6, 7)), 0) << i;
    }
  }
}

// Normals transform by the inverse transpose, also under mirroring: z = -1 flips the square, x = -1 and y = -1 do not.
TEST(TriangleMesh, NormalOfARectangleIsTheTransformedOne) {
  mc::Pcg random(5);
  int mirrored = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Transform m;
    for (int i = 0; i < 9; ++i) m.linear(i / 3, i % 3) = 2 * random.uniform<double>() - 1;
    for (int i = 0; i < 3; ++i) m.translation[i] = 2 * random.uniform<double>() - 1;
    if (trial < 8) m = scaled_at({trial & 1 ? -1. : 1., trial & 2 ? -1. : 1., trial & 4 ? -1. : 1.}, {0, 0, 0});
    const Eigen::Matrix3d linear = m.linear;
    mirrored += linear.determinant() < 0;
    const Vec3 expected = (linear.inverse().transpose() * Vec3d::UnitZ()).normalized().cast<Float>();
    const TriangleMesh square = TriangleMesh::rectangle(m);
    for (int i = 0; i < 2; ++i)
      EXPECT_LE((square.point(static_cast<std::size_t>(i), 0.3, 0.3).ng - expected).norm(), 1e-4) << m.linear;
  }
  EXPECT_GT(mirrored, 50);
}

TEST(TriangleMesh, ShadingNormalsKeepToTheGeometricSide) {
  const TriangleMesh mesh({corners[0], corners[1], corners[2]}, {{0, 1, 2}},
                          {Vec3(0, 0, -1), Vec3(0, 0, -1), Vec3(1, 0, -1).normalized()});
  const SurfacePoint s = mesh.point(0, 0.25, 0.5);
  EXPECT_GT(s.ns.dot(s.ng), 0);
  EXPECT_LE(std::abs(s.ns.norm() - 1), 1e-6);
  EXPECT_EQ(s.p, Vec3(Float(0.25), Float(0.5), 0));
}

} // namespace
