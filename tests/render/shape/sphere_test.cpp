#include <render/shape/sphere.h>

#include "support/random_direction.h"

#include <mc/core/error.h>
#include <mc/core/frame.h>
#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

/// Mean of 1/pdf over a grid of u. If the pdf is correct, it is the solid angle of the shape.
template <class S> double solid_angle(const S& shape, const Vec3& ref, int n = 512) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (const auto s =
              shape.sample(ref, Vec2((Float(i) + Float(0.5)) / Float(n), (Float(j) + Float(0.5)) / Float(n))))
        sum += 1 / double(s->pdf);
  return sum / (double(n) * n);
}

TEST(Sphere, RejectsBadNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Sphere(Vec3d(nan, 0, 0), 1), mc::Error);
  EXPECT_THROW(Sphere(Vec3d(10 * double(std::numeric_limits<Float>::max()), 0, 0), 1), mc::Error);
  for (const double radius : {0.0, -1.0, nan, mc::infinity<double>, 2 * double(std::numeric_limits<Float>::max())})
    EXPECT_THROW(Sphere(Vec3d::Zero(), radius), mc::Error) << radius;
  EXPECT_THROW(Sphere::cap(Vec3d::Zero(), 1, Vec3d::Zero(), 1), mc::Error);
  for (const double height : {0.0, 2.1, nan})
    EXPECT_THROW(Sphere::cap(Vec3d::Zero(), 1, Vec3d(0, 0, 1), height), mc::Error) << height;
}

// uv are angles about the axes, within the rounding of a point, for rotated and mirrored axes too. u is arbitrary at
// the poles.
TEST(Sphere, TextureCoordinatesAreAngles) {
  mc::Pcg random(9);
  for (int trial = 0; trial < 500; ++trial) {
    const auto direction = [&] { return mc::UniformSphere<double>{}.sample(random.point<double, 2>()); };
    const auto frame = mc::Frame<double>::from_z(direction());
    Eigen::Matrix3d axes;
    axes << frame.x, frame.y, frame.z;
    if (trial % 2 == 0) axes.col(0) *= -1;
    const double radius = std::pow(10, 6 * random.uniform<double>() - 3);
    const Vec3d center = radius * direction();
    const double least_u = trial % 4 < 2 ? 0 : -0.5;
    const Sphere s = Sphere(center, radius, trial % 3 == 0).with_uv_axes(axes, least_u);
    const double u = random.uniform<double>(), v = 0.001 + 0.998 * random.uniform<double>(),
                 sine = std::sin(v * mc::pi<double>);
    const Vec3d d = axes * Vec3d(sine * std::cos(2 * mc::pi<double> * u), sine * std::sin(2 * mc::pi<double> * u),
                                 std::cos(v * mc::pi<double>));
    const Ray ray{(center + 3 * radius * d).cast<Float>(), (-d).cast<Float>()};
    const auto t = s.intersect(ray);
    ASSERT_TRUE(t);
    const Hit hit{*t, 0, 0, 0, 0};
    const auto uv = s.uv(hit, s.surface_point(ray, hit));
    EXPECT_GE(uv[0], least_u);
    EXPECT_LE(uv[0], least_u + 1);
    EXPECT_NEAR(std::remainder(uv[0] - u, 1.0) * sine, 0, 1e-6);
    EXPECT_NEAR(uv[1], v, 1e-6);
  }
  EXPECT_THROW(Sphere(Vec3d::Zero(), 1).with_uv_axes(2 * Eigen::Matrix3d::Identity()), mc::Error);
}

// Float rays against spheres of every size, compared with long double. Except for tangent rays, double loses a few
// roundings of the coordinates: |dt| <= 2^-46 (|o| + radius + |centre|) / cos at the surface.
TEST(Sphere, CrossingsAreAccurateUpToRadius1e5) {
  using L = long double;
  mc::Pcg random(1);
  for (const double radius : {1e-3, 1.0, 600.0, 1e5})
    for (int i = 0; i < 2000; ++i) {
      const Vec3d center = radius * (random.point<double, 3>() - Vec3d::Constant(0.5));
      const Vec3 o =
          (center + (i % 2 ? 1.001 : 3.0) * radius * support::random_direction(random).cast<double>()).cast<Float>();
      const Ray ray{
          o,
          Vec3(center.cast<Float>() + Float(radius) * Float(0.9) * support::random_direction(random) - o).normalized()};
      L oc[3], a = 0, b = 0, c = -L(radius) * L(radius);
      for (int k = 0; k < 3; ++k) {
        oc[k] = L(o[k]) - L(center[k]);
        a += L(ray.d[k]) * L(ray.d[k]);
        b -= oc[k] * L(ray.d[k]);
        c += oc[k] * oc[k];
      }
      const L discriminant = b * b - a * c;
      if (discriminant < 1e-4L * a * L(radius) * L(radius)) continue;
      const L near = (b - std::sqrt(discriminant)) / a, far = (b + std::sqrt(discriminant)) / a,
              truth = near > 0 ? near : far;
      const auto t = Sphere(center, radius).intersect(ray);
      ASSERT_EQ(t.has_value(), truth > 0) << "radius " << radius;
      if (!t) continue;
      EXPECT_LE(std::abs(double(L(*t) - truth)), 0x1p-46 * 100 * (o.cast<double>().norm() + radius + center.norm()))
          << "radius " << radius;
    }
}

TEST(Sphere, SolidAngleOfTheCone) {
  EXPECT_NEAR(solid_angle(Sphere(Vec3d(0, 0, 2), 1), Vec3::Zero()), 0.841787214477, 1e-5);
  EXPECT_NEAR(solid_angle(Sphere(Vec3d(190, 90, 190), 90), Vec3::Zero()), 0.325319809946, 1e-5);
  EXPECT_NEAR(solid_angle(Sphere(Vec3d(190, 90, 190), 90), Vec3(278, 0, Float(279.5))), 1.177008465985, 1e-5);
  // Far away, where 1 - cos would cancel, the solid angle is pi R^2 / d^2.
  for (const double d : {1e3, 1e5, 1e7})
    EXPECT_NEAR(solid_angle(Sphere(Vec3d(0, 0, d), 1), Vec3::Zero(), 16) / (mc::pi<double> / (d * d)), 1, 2e-6) << d;
}

TEST(Sphere, FromInsideTheSolidAngleIsAll) {
  EXPECT_NEAR(solid_angle(Sphere(Vec3d(0, 0, 0), 2, true), Vec3(Float(0.3), Float(-0.5), 1)), 4 * mc::pi<double>, 1e-3);
}

TEST(Sphere, SampleSaysWhatPdfSays) {
  mc::Pcg random(2);
  for (const Sphere& s :
       {Sphere(Vec3d(1, 2, 3), 0.5), Sphere(Vec3d(0, 0, 0), 10, true), Sphere(Vec3d(0, -1e5 - 1, 0), 1e5),
        Sphere::cap(Vec3d(0, 605, 0), 600, Vec3d(0, -1, 0), 0.27)})
    for (int i = 0; i < 2000; ++i) {
      Vec2 u = random.point<Float, 2>();
      if (i % 10 == 0) u[i % 20 == 0] = i % 40 < 20 ? Float(0) : mc::one_minus_epsilon<Float>;
      const Vec3 ref = random.point<Float, 3>();
      const auto sample = s.sample(ref, u);
      if (!sample) continue;
      EXPECT_EQ(sample->pdf, s.pdf(ref, sample->wi, sample->point));
      EXPECT_LE(std::abs(sample->wi.squaredNorm() - 1), 8 * std::numeric_limits<Float>::epsilon());
      EXPECT_GT(sample->pdf, 0);
      if (s.is_cap()) {
        EXPECT_GE((sample->point.p.cast<double>() - s.center()).dot(s.axis()), s.radius() - s.height() - 1e-4);
      }
    }
}

TEST(Sphere, DirectionPdfSumsTheCrossings) {
  const Sphere s(Vec3d(0, 0, 0), 2, true);
  mc::Pcg random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 ref = random.point<Float, 3>();
    const auto sample = s.sample(ref, random.point<Float, 2>());
    ASSERT_TRUE(sample.has_value());
    EXPECT_LE(std::abs(s.pdf(ref, sample->wi) / sample->pdf - 1), 2e-5);
  }
  const Sphere outside(Vec3d(0, 0, 3), 1);
  EXPECT_EQ(outside.pdf(Vec3::Zero(), Vec3(1, 0, 0)), 0);
  EXPECT_GT(outside.pdf(Vec3::Zero(), Vec3(0, 0, 1)), 0);
}

// The light of smallpt: the visible cap of height .27 of a sphere of radius 600.
TEST(Sphere, CapsHaveTheirOwnAreaAndAreHitOnlyThere) {
  const Sphere cap = Sphere::cap(Vec3d(50, 681.6 - 0.27, 81.6), 600, Vec3d(0, -1, 0), 0.27);
  EXPECT_NEAR(cap.area(), 1017.87601976, 1e-6);
  EXPECT_TRUE(cap.intersect({Vec3(50, 40, Float(81.6)), Vec3(0, 1, 0)}).has_value());
  EXPECT_TRUE(cap.intersect({Vec3(Float(67.9), 40, Float(81.6)), Vec3(0, 1, 0)}).has_value())
      << "radius of the rim is 17.998";
  EXPECT_EQ(cap.intersect({Vec3(Float(68.1), 40, Float(81.6)), Vec3(0, 1, 0)}), std::nullopt);
  EXPECT_EQ(Sphere(Vec3d::Zero(), 2).area(), 16 * mc::pi<double>);
}

TEST(Sphere, NormalsPointOutwardOrInward) {
  const Ray ray{Vec3(0, 0, 5), Vec3(0, 0, -1)};
  for (const bool inside_out : {false, true}) {
    const Sphere s(Vec3d::Zero(), 1, inside_out);
    const Hit hit{*s.intersect(ray), 7, 0, 0, 0};
    EXPECT_EQ(s.surface_point(ray, hit).ng.z(), inside_out ? -1 : 1);
  }
}

// Points on the sphere round to either side of it. A viewer there must sample the opposite wall, not its own
// neighbourhood.
TEST(Sphere, SeenFromItsOwnSurfaceIsSampledByArea) {
  mc::Pcg random(21);
  for (const Vec3d& center : {Vec3d(0, 0, 0), Vec3d(30, -7, 2)}) {
    const Sphere sphere(center, 1, true);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 ref = (center + support::random_direction(random).cast<double>().normalized()).cast<Float>();
      const auto s = sphere.sample(ref, random.point<Float, 2>());
      ASSERT_TRUE(s.has_value()) << i;
      // With density 1 / (4 pi) in area and distance^2 / cos = 2 distance on a unit sphere, pdf = distance / (2 pi).
      const double distance = (s->point.p - ref).cast<double>().norm();
      EXPECT_NEAR(s->pdf, distance / (2 * mc::pi<double>), 1e-5 / distance) << i;
    }
  }
}

// Tiny distant spheres give a valid sample or none, and never throw.
TEST(Sphere, TheSmallestFromAfarAreNoError) {
  for (const double radius : {1e-17, 1e-19, 1e-30})
    for (const double u : {0.1, 0.3, 0.9}) { // points on the far half give no sample
      const auto s = Sphere(Vec3d::Zero(), radius).sample_direction(Vec3(0, 0, 5), {Float(u), Float(0.6)});
      EXPECT_TRUE(!s || s->pdf >= Float(1e33)) << radius;
      EXPECT_TRUE(!s || std::abs(s->wi.z() + 1) < 1e-6) << radius;
    }
}

} // namespace
