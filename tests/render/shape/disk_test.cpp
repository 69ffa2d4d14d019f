#include <render/shape/disk.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include "support/files.h"

#include <array>

namespace {

using namespace render;

const Transform oblique = Transform::translate({1, 2, 3}) * Transform::rotate({1, 2, -1}, 50) *
                          Transform::columns({2, 0, 0}, {1, 0.5, 0}, {0.3, 0.2, 1}, Vec3d::Zero());

// A ray hits the ellipse where its image under the inverse map hits the unit disk.
TEST(Disk, IsHitAsTheUnitDiskBehindTheMap) {
  const Disk disk(oblique);
  const Eigen::Matrix3d inverse = oblique.linear.inverse();
  mc::Pcg random(2);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 o = (Vec3d(1, 2, 3) + 4 * (random.point<double, 3>() - Vec3d::Constant(0.5))).cast<Float>();
    const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    const Vec3d local_o = inverse * (o.cast<double>() - oblique.translation), local_d = inverse * d.cast<double>();
    const double t = -local_o.z() / local_d.z(), r = (local_o + t * local_d).norm();
    const auto hit = disk.intersect({o, d});
    if (std::abs(r - 1) < 1e-9) continue;
    ASSERT_EQ(hit.has_value(), t > 0 && r < 1);
    EXPECT_EQ(disk.pdf(o, d) > 0, hit.has_value());
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(*hit, t, 1e-12 * (1 + t));
    EXPECT_FALSE(disk.intersect({o, d, Float(0.9 * t)}));
    const SurfacePoint p = disk.surface_point({o, d}, {*hit});
    const mc::Vec2<double> uv = disk.uv({}, p);
    const Vec3d local = local_o + t * local_d;
    EXPECT_NEAR(uv[0], r, 1e-6);
    EXPECT_NEAR(uv[0] * std::cos(2 * mc::pi<double> * uv[1]), local.x(), 2e-6);
    EXPECT_NEAR(uv[0] * std::sin(2 * mc::pi<double> * uv[1]), local.y(), 2e-6);
  }
  EXPECT_GT(hits, 300);
}

// Points are uniform in area: equal counts in 16 sectors and in 16 rings of equal area of the unit disk. Each count is
// 1000 within five standard deviations of 31.
TEST(Disk, AreaIsSampledUniformly) {
  const Disk disk(oblique);
  mc::Pcg random(3);
  std::array<int, 16> rings = {}, sectors = {};
  const Eigen::Matrix3d inverse = oblique.linear.inverse();
  for (int i = 0; i < 16'000; ++i) {
    const SurfacePoint p = *disk.sample_area(random.point<Float, 2>());
    const Vec3d local = inverse * (p.p.cast<double>() - oblique.translation);
    EXPECT_NEAR(local.z(), 0, 1e-6);
    EXPECT_LE((disk.bounding_ball().center - p.p.cast<double>()).norm(), disk.bounding_ball().radius + 1e-6);
    EXPECT_LE(disk.box().exteriorDistance(p.p.cast<double>()), 1e-6);
    ++rings[std::min<std::size_t>(static_cast<std::size_t>(16 * local.squaredNorm()), 15)];
    ++sectors[static_cast<std::size_t>(16 * disk.uv({}, p)[1])];
  }
  for (const auto& counts : {rings, sectors})
    for (const int n : counts) EXPECT_NEAR(n, 1000, 155);
}

TEST(Disk, MeasuresAreClosedForms) {
  const Disk disk(Transform::translate({1, 2, 3}) * Transform::scale({3, 2, 5}));
  EXPECT_NEAR(disk.area(), 6 * mc::pi<double>, 1e-12);
  EXPECT_NEAR(disk.bounding_ball().radius, 3, 1e-12);
  EXPECT_LE((disk.box().sizes() - Vec3d(6, 4, 0)).norm(), 1e-12);
  EXPECT_LE((disk.bounding_ball().center - Vec3d(1, 2, 3)).norm(), 1e-12);
  // A rotated disk of radius 2 touches each side of its box.
  const Disk turned(Transform::rotate({1, 2, -1}, 50) * Transform::scale(Vec3d::Constant(2)));
  EXPECT_NEAR(turned.bounding_ball().radius, 2, 1e-12);
  const Vec3d n = Transform::rotate({1, 2, -1}, 50).vector(Vec3d::UnitZ());
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(turned.box().max()[a], 2 * std::sqrt(1 - n[a] * n[a]), 1e-12);
}

// The density of a sample is distance^2 / (|cos| area), also by its direction alone.
TEST(Disk, SamplesHaveTheirDensity) {
  const Disk disk(oblique);
  const Vec3 ref(-1, 1, Float(0.5));
  mc::Pcg random(4);
  for (int i = 0; i < 1000; ++i) {
    const auto s = disk.sample(ref, random.point<Float, 2>());
    ASSERT_TRUE(s);
    const Vec3d way = (s->point.p - ref).cast<double>();
    const double pdf = way.squaredNorm() / (std::abs(s->point.ng.cast<double>().dot(way.normalized())) * disk.area());
    EXPECT_NEAR(double(s->pdf) / pdf, 1, 1e-5);
    EXPECT_EQ(disk.pdf(ref, s->wi, s->point), s->pdf);
    if (const Float by_direction = disk.pdf(ref, s->wi); by_direction > 0) { // rounding may miss the outline
      EXPECT_NEAR(double(by_direction) / pdf, 1, 1e-5);
    }
    const auto d = disk.sample_direction(ref, random.point<Float, 2>());
    ASSERT_TRUE(d);
    EXPECT_GT(d->pdf, 0);
  }
  EXPECT_FALSE(disk.sample(disk.sample_area({Float(0.5), Float(0.5)})->p, {Float(0.5), Float(0.5)}));
}

// The normal is that of the square that `rectangle` makes of the same map, also under mirroring.
TEST(Disk, NormalFollowsTheMap) {
  const Vec2 u(Float(0.25), Float(0.75));
  for (const Transform& mirror : {Transform(), Transform::scale({-1, 1, 1}), Transform::scale({1, 1, -1})}) {
    const Transform to_world = oblique * mirror;
    const Vec3 normal = to_world.normal(Vec3d::UnitZ()).normalized().cast<Float>();
    EXPECT_LE((Disk(to_world).sample_area(u)->ng - normal).norm(), 1e-6);
    EXPECT_LE((Disk(to_world, true).sample_area(u)->ng + normal).norm(), 1e-6);
  }
}

TEST(Disk, RefusesNonsense) {
  const auto error = [](const Transform& to_world) { return support::error_of([&] { Disk d(to_world); }); };
  EXPECT_THAT(error(Transform::scale({1, 0, 1})), testing::HasSubstr("makes a line of the disk"));
  EXPECT_THAT(error(Transform::scale(Vec3d::Zero())), testing::HasSubstr("makes a line of the disk"));
  EXPECT_THAT(error(Transform::translate({std::nan(""), 0, 0})), testing::HasSubstr("must be finite"));
  EXPECT_THAT(error(Transform::scale(Vec3d::Constant(1e200))), testing::HasSubstr("must be finite"));
}

} // namespace
