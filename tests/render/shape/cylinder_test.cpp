#include <render/shape/cylinder.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include "support/files.h"

#include <array>

namespace {

using namespace render;

const Vec3d base(1, 2, 3), end(2, 2.5, 1);

// Steps along each ray find where its distance from the axis passes the radius between the two ends.
TEST(Cylinder, IsHitWhereTheDistanceFromTheAxisIsTheRadius) {
  const Cylinder cylinder(base, end, 0.8);
  const Vec3d axis = (end - base).normalized();
  mc::Pcg random(2);
  int hits = 0, inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 o = ((base + end) / 2 + 4 * (random.point<double, 3>() - Vec3d::Constant(0.5))).cast<Float>();
    const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    const auto at = [&](double t) {
      const Vec3d p = o.cast<double>() + t * d.cast<double>() - base;
      const double height = p.dot(axis);
      return std::pair((p - height * axis).norm(), height);
    };
    const auto hit = cylinder.intersect({o, d});
    EXPECT_EQ(cylinder.pdf(o, d) > 0, hit.has_value());
    inside += at(0).first < 0.8;
    if (!hit) {
      // No crossing up to there: the sign of the distance minus the radius changes only beyond an end.
      for (double t = 0; t < 8; t += 0.05) {
        const auto [r, z] = at(t);
        const auto [next_r, next_z] = at(t + 0.05);
        const double height = (end - base).norm();
        if (z > 0.1 && z < height - 0.1 && next_z > 0.1 && next_z < height - 0.1) {
          ASSERT_EQ(r > 0.8, next_r > 0.8) << i;
        }
      }
      continue;
    }
    ++hits;
    const auto [r, z] = at(*hit);
    EXPECT_NEAR(r, 0.8, 1e-12);
    EXPECT_GE(z, 0);
    EXPECT_LE(z, (end - base).norm());
    EXPECT_FALSE(cylinder.intersect({o, d, Float(0.99 * *hit)})) << "an earlier hit";
    const SurfacePoint p = cylinder.surface_point({o, d}, {*hit});
    EXPECT_LE((p.p.cast<double>() - (o.cast<double>() + *hit * d.cast<double>())).lpNorm<Eigen::Infinity>(),
              double(p.error) + 1e-12);
    EXPECT_NEAR(cylinder.uv({}, p)[1], z / (end - base).norm(), 1e-6);
    EXPECT_NEAR(p.ng.cast<double>().dot(axis), 0, 1e-6);
    // A ray that leaves outward hits nothing; one that leaves inward crosses the inside.
    const auto again = cylinder.intersect(p.spawn_ray(d));
    if (p.ng.dot(d) > 0) {
      EXPECT_FALSE(again) << i;
    } else if (again) {
      EXPECT_LT(at(*hit + *again / 2).first, 0.8) << i;
    }
  }
  EXPECT_GT(hits, 3000);
  EXPECT_GT(inside, 1000);
}

// Equal counts in 16 sectors and in 16 sections. Each count is 1000 within five standard deviations of 31.
TEST(Cylinder, AreaIsSampledUniformly) {
  const Cylinder cylinder(base, end, 0.8);
  mc::Pcg random(3);
  std::array<int, 16> sections = {}, sectors = {};
  for (int i = 0; i < 16'000; ++i) {
    const SurfacePoint p = *cylinder.sample_area(random.point<Float, 2>());
    const mc::Vec2<double> uv = cylinder.uv({}, p);
    EXPECT_LE((cylinder.bounding_ball().center - p.p.cast<double>()).norm(), cylinder.bounding_ball().radius + 1e-6);
    EXPECT_LE(cylinder.box().exteriorDistance(p.p.cast<double>()), 1e-6);
    ++sections[std::min<std::size_t>(static_cast<std::size_t>(16 * uv[1]), 15)];
    ++sectors[static_cast<std::size_t>(16 * uv[0])];
  }
  for (const auto& counts : {sections, sectors})
    for (const int n : counts) EXPECT_NEAR(n, 1000, 155);
}

TEST(Cylinder, MeasuresAreClosedForms) {
  const Cylinder cylinder({0, 0, 1}, {0, 0, 4}, 2);
  EXPECT_NEAR(cylinder.area(), 12 * mc::pi<double>, 1e-12);
  EXPECT_LE((cylinder.box().min() - Vec3d(-2, -2, 1)).norm(), 1e-12);
  EXPECT_LE((cylinder.box().max() - Vec3d(2, 2, 4)).norm(), 1e-12);
  EXPECT_NEAR(cylinder.bounding_ball().radius, 2.5, 1e-12);
  EXPECT_NEAR(cylinder.intersect({Vec3(5, 0, 2), Vec3(-1, 0, 0)}).value(), 3, 1e-12);
  EXPECT_FALSE(cylinder.intersect({Vec3(0, 0, 9), Vec3(0, 0, -1)})) << "along the axis";
  EXPECT_FALSE(cylinder.intersect({Vec3(5, 0, 5), Vec3(-1, 0, 0)})) << "beyond the end";
  // Over all directions from a point of the axis, the density is 1 where there is a wall.
  const Vec3 middle(0, 0, Float(2.5));
  double seen = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      seen +=
          double(cylinder.pdf(middle, mc::UniformSphere<Float>{}.sample({Float(i + 0.5) / n, Float(j + 0.5) / n}))) *
          4 * mc::pi<double> / (n * n);
  EXPECT_NEAR(seen, 1, 0.01);
}

// The density of a direction is the sum over both walls.
TEST(Cylinder, SamplesHaveTheirDensity) {
  const Cylinder cylinder(base, end, 0.8, true);
  const Vec3 ref(-1, 1, Float(0.5));
  mc::Pcg random(4);
  for (int i = 0; i < 1000; ++i) {
    const auto s = cylinder.sample(ref, random.point<Float, 2>());
    ASSERT_TRUE(s);
    const Vec3d way = (s->point.p - ref).cast<double>();
    const double cosine = std::abs(s->point.ng.cast<double>().dot(way.normalized()));
    const double pdf = way.squaredNorm() / (cosine * cylinder.area());
    EXPECT_NEAR(double(s->pdf) / pdf, 1, 1e-6 + 5e-7 / cosine); // a float cosine has an error of a few eps
    EXPECT_EQ(cylinder.pdf(ref, s->wi, s->point), s->pdf);
    if (const Float by_direction = cylinder.pdf(ref, s->wi); by_direction > 0) { // rounding may miss the outline
      EXPECT_GE(double(by_direction) / pdf, 1 - 1e-3);
    }
    const Vec3d axis = (end - base).normalized(), from_base = s->point.p.cast<double>() - base;
    EXPECT_NEAR((from_base - from_base.dot(axis) * axis).dot(s->point.ng.cast<double>()), -0.8, 1e-6) << "inward";
    const auto d = cylinder.sample_direction(ref, random.point<Float, 2>());
    ASSERT_TRUE(d);
    EXPECT_GT(d->pdf, 0);
  }
}

TEST(Cylinder, RefusesNonsense) {
  const auto error = [](const Vec3d& from, const Vec3d& to, double radius) {
    return support::error_of([&] { Cylinder c(from, to, radius); });
  };
  EXPECT_THAT(error(base, base, 1), testing::HasSubstr("its ends must differ"));
  EXPECT_THAT(error(base, end, 0), testing::HasSubstr("radius 0 must be > 0"));
  EXPECT_THAT(error(base, end, -1), testing::HasSubstr("radius -1 must be > 0"));
  EXPECT_THAT(error(base, {std::nan(""), 0, 0}, 1), testing::HasSubstr("must be finite"));
  EXPECT_THAT(error(base, end, HUGE_VAL), testing::HasSubstr("must be finite"));
}

} // namespace
