#include <render/accel/bvh.h>

#include "support/random_direction.h"

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

/// A rotated box of the given half size.
TriangleMesh turned_box(double half, const Vec3d& center) {
  const Transform turn =
      Transform::columns({0.36, -0.8, 0.48}, {0.48, 0.6, 0.64}, {-0.8, 0, 0.6}, center.cast<double>());
  return TriangleMesh::box(turn * Transform::scale(Vec3d::Constant(half)));
}

/// Outward directions. Every other one is grazing, with slopes down to 1e-5, which a float normal still resolves.
Vec3 outward(const SurfacePoint& s, mc::Pcg& random, bool grazing) {
  Vec3 d = support::random_direction(random);
  if (d.dot(s.ng) < 0) d = -d;
  if (!grazing) return d;
  const Float slope = std::pow(Float(10), -5 * random.uniform<Float>());
  return (Vec3(d - d.dot(s.ng) * s.ng).normalized() + slope * s.ng).normalized();
}

/// Outward rays from a convex shape never hit it again.
void expect_no_self_hits(const Shape& shape, const Vec3d& center, double size, const std::string& what) {
  const Bvh bvh(std::span(&shape, 1));
  mc::Pcg random(3);
  int spawned = 0, self_hits = 0;
  for (int i = 0; i < 4000; ++i) {
    // From near, far and very far origins: the error of the point does not grow with the length of the ray.
    const double far = size * (i % 3 == 0 ? 3 : i % 3 == 1 ? 100 : 1e4);
    const Vec3 o = (center + far * support::random_direction(random).cast<double>()).cast<Float>();
    const Vec3 target = (center + 0.5 * size * support::random_direction(random).cast<double>()).cast<Float>();
    const Ray ray{o, Vec3(target - o).normalized()};
    const auto hit = bvh.intersect(ray);
    if (!hit) continue;
    const SurfacePoint s = shape.surface_point(ray, *hit);
    ++spawned;
    self_hits += bvh.occluded(s.spawn_ray(outward(s, random, i % 2 == 0)));
  }
  EXPECT_GE(spawned, 1000) << what;
  EXPECT_EQ(self_hits, 0) << what << ", of " << spawned;
}

TEST(SurfacePoint, SpawnedRaysDoNotMeetTheirMesh) {
  for (const double half : {1e-3, 1.0, 1e3, 1e6})
    for (const double away : {0.0, 1.0, 10.0}) {
      const Vec3d center = away * half * Vec3d(1, -0.7, 0.3);
      expect_no_self_hits(turned_box(half, center), center, half,
                          fmt::format("box of half size {} at {} sizes", half, away));
    }
}

TEST(SurfacePoint, SpawnedRaysDoNotMeetTheirSphere) {
  for (const double radius : {1e-3, 1.0, 1e3, 1e5, 1e6})
    for (const double away : {0.0, 1.0, 10.0}) {
      const Vec3d center = away * radius * Vec3d(1, -0.7, 0.3);
      expect_no_self_hits(Sphere(center, radius), center, radius,
                          fmt::format("sphere of radius {} at {} radii", radius, away));
    }
}

// The walls of smallpt: points with coordinates of about 100 on a sphere of radius 1e5.
TEST(SurfacePoint, SpawnedRaysDoNotMeetAHugeSphereNearby) {
  const Shape shape = Sphere(Vec3d(50, -1e5, 81.6), 1e5);
  const Bvh bvh(std::span(&shape, 1));
  mc::Pcg random(4);
  int spawned = 0, self_hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray{100 * random.point<Float, 3>() + Vec3(0, 1, 0),
                  Vec3(support::random_direction(random) - Vec3(0, Float(1.05), 0)).normalized()};
    const auto hit = bvh.intersect(ray);
    if (!hit) continue;
    const SurfacePoint s = shape.surface_point(ray, *hit);
    ++spawned;
    self_hits += bvh.occluded(s.spawn_ray(outward(s, random, i % 2 == 0)));
  }
  EXPECT_GE(spawned, 15000);
  EXPECT_EQ(self_hits, 0) << "of " << spawned;
}

// The true surface lies within `error` of p in each coordinate. For a sphere the distance to the centre shows it, for a
// plane the distance along the normal.
TEST(SurfacePoint, ErrorBoundsHold) {
  mc::Pcg random(5);
  for (const double scale : {1e-3, 1.0, 1e6})
    for (int i = 0; i < 1000; ++i) {
      const Vec3d center = scale * random.point<double, 3>();
      const double radius = scale * (0.01 + random.uniform<double>());
      const auto sphere =
          Sphere(center, radius).sample((center + 3 * radius * Vec3d(0, 0, 1)).cast<Float>(), random.point<Float, 2>());
      ASSERT_TRUE(sphere.has_value());
      const Vec3d from_center = sphere->point.p.cast<double>() - center;
      EXPECT_LE(std::abs(from_center.norm() - radius),
                double(sphere->point.error) * from_center.normalized().lpNorm<1>());

      const TriangleMesh mesh = turned_box(radius, center);
      const auto box = mesh.sample((center + 3 * radius * Vec3d(0, 0, 1)).cast<Float>(), random.point<Float, 2>());
      if (!box) continue;
      const auto v = mesh.vertices(static_cast<std::size_t>(box->point.prim));
      const Vec3d a = v[0].cast<double>();
      const Vec3d n = mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a).normalized();
      EXPECT_LE(std::abs(n.dot(box->point.p.cast<double>() - a)), double(box->point.error) * n.lpNorm<1>());
    }
}

TEST(SurfacePoint, OriginsMoveToTheSideOfTheRay) {
  SurfacePoint s;
  s.p = Vec3(1, 2, 3);
  s.error = Float(1e-6);
  s.ng = s.ns = Vec3(0, 0, 1);
  EXPECT_GT(s.offset_origin(Vec3(0, 0, 1)).z(), 3);
  EXPECT_LT(s.offset_origin(Vec3(0, 0, -1)).z(), 3);
  EXPECT_LE(std::abs(s.offset_origin(Vec3(0, 0, 1)).z() - 3), 2e-6);
  EXPECT_EQ(s.offset_origin(Vec3(0, 0, 1)).x(), 1);
}

// Rounding moves a sample of a flat shape to either side of its plane, yet no direction leads to another point of it.
// Only between its two triangles, with normals that differ by rounding, may one exist; it carries negligible light.
TEST(SurfacePoint, PointsOfOnePlaneDoNotSeeEachOther) {
  mc::Pcg random(7);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d axis = support::random_direction(random).cast<double>(),
                to = support::random_direction(random).cast<double>();
    const auto square = TriangleMesh::rectangle(Transform::translate(10 * to) * Transform::rotate(axis, 77));
    const auto a = square.sample(Vec3::Zero(), random.point<Float, 2>());
    ASSERT_TRUE(a);
    const auto b = square.sample(a->point.p, random.point<Float, 2>());
    if (!b || !a->point.spawn_ray_to(b->point, b->wi)) continue;
    EXPECT_NE(a->point.ng, b->point.ng) << i;
    EXPECT_LE(std::abs(b->wi.dot(a->point.ng)) / b->pdf, 1e-10) << i;
  }
}

// A shadow ray between two convex shapes that face each other hits neither.
TEST(SurfacePoint, ShadowRaysStopBeforeTheirTarget) {
  mc::Pcg random(6);
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Vec3d center(scale * 5, scale, 0);
    const std::vector<Shape> shapes = {turned_box(scale, Vec3d::Zero()), Sphere(center, scale)};
    const Bvh bvh(shapes);
    int tried = 0, blocked = 0;
    for (int i = 0; i < 4000; ++i) {
      const auto a = shapes[0].sample(center.cast<Float>(), random.point<Float, 2>());
      if (!a) continue;
      const auto b = shapes[1].sample(a->point.p, random.point<Float, 2>());
      if (!b) continue;
      // Both points must truly face each other; slopes below 1e-4 are left to rounding.
      if (a->point.ng.dot(b->wi) < Float(1e-4) || b->point.ng.dot(b->wi) > Float(-1e-4)) continue;
      ++tried;
      const auto there = a->point.spawn_ray_to(b->point, b->wi), back = b->point.spawn_ray_to(a->point, -b->wi);
      ASSERT_TRUE(there && back);
      blocked += bvh.occluded(*there) || bvh.occluded(*back);
    }
    EXPECT_GE(tried, 1000);
    EXPECT_EQ(blocked, 0) << "scale " << scale << ", of " << tried;
  }
}

} // namespace
