// Ambient occlusion against closed forms. About twenty t-tests at alpha = 1e-6, fixed seeds.

#include <render/scene/builder.h>

#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

#include <cmath>

#include "support/traced.h"

namespace {

using namespace render;

constexpr double everywhere = HUGE_VAL;

void expect_open(const Scene& scene, const Ray& ray, double reach, double expected, const std::string& what) {
  const mc::Moments moments = support::aov_samples(scene, ray, Aov(Aov::ambient_occlusion, reach), 20'000);
  if (moments.std_error() == 0) EXPECT_EQ(moments.mean(), expected) << what;
  else EXPECT_GE(mc::t_test(moments, expected).p, 1e-6) << what << ": " << moments.mean() << " for " << expected;
}

// A floor y = 0 and a wall x = 0 of height h, at any scale, so wide that their ends do not matter.
Scene corner(double h, double scale) {
  const double far = 3e3 * scale;
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(TriangleMesh::rectangle(Transform::columns({far, 0, 0}, {0, 0, -far}, Vec3d::UnitY(), {far, 0, 0})),
              {gray});
  builder.add(TriangleMesh::rectangle(
                  Transform::columns({0, 0, -far}, {0, h * scale / 2, 0}, Vec3d::UnitX(), {0, h * scale / 2, 0})),
              {gray});
  return builder.build();
}

Ray down_to(double x, double scale) { return {Vec3d(x * scale, 0.01 * scale, 0).cast<Float>(), Vec3(0, -1, 0)}; }

// At the distance x from a wall of height h, the wall's form factor (1 - x / sqrt(x^2 + h^2)) / 2 is occluded.
TEST(AmbientOcclusion, WallBesideFloor_MatchesClosedForm) {
  for (const double scale : {1e-10, 1.0, 1e10})
    for (const double x : {0.1, 1.0, 5.0})
      expect_open(corner(2, scale), down_to(x, scale), everywhere, 1 - (1 - x / std::hypot(x, 2.0)) / 2,
                  fmt::format("{} at {}", x, scale));
}

// A wall without end occludes the directions that hit it within the range r. They are half of a cone about the wall's
// normal with the cosine c = x / r. On the floor this is a segment of the unit disk: (acos c - c sqrt(1 - c^2)) / pi.
TEST(AmbientOcclusion, IgnoresOccludersBeyondMaxDistance) {
  for (const double scale : {1e-10, 1.0, 1e10})
    for (const double x : {0.1, 0.5, 0.9, 1.1}) {
      const double c = std::min(x, 1.0);
      expect_open(corner(2, scale), down_to(x, scale), scale,
                  1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / mc::pi<double>, fmt::format("{} at {}", x, scale));
    }
}

// In a ball of radius 1 the other side is at the distance 2 cos, beyond r for a share 1 - r^2 / 4 of the sky's light.
// From outside nothing is occluded, for either orientation of the normals, nor without a hit.
TEST(AmbientOcclusion, InsideAndOnSphere_MatchesClosedForm) {
  for (const bool inside_out : {false, true}) {
    SceneBuilder builder;
    builder.add(Sphere(Vec3d(1, 2, 3), 1, inside_out), {builder.add(Lambert())});
    const Scene scene = builder.build();
    const Vec3 middle(1, 2, 3), d = Vec3(1, -2, 3).normalized();
    for (const double r : {0.5, 1.0, 1.9}) expect_open(scene, {middle, d}, r, 1 - r * r / 4, fmt::format("{}", r));
    expect_open(scene, {middle, d}, everywhere, 0, "in a closed ball");
    expect_open(scene, {Vec3(middle - 5 * d), d}, everywhere, 1, "on a ball");
    expect_open(scene, {Vec3(middle + 5 * d), d}, everywhere, 1, "beyond");
  }
}

} // namespace
