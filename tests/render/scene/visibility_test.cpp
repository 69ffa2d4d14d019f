// Masks under every strategy, against closed forms.

#include <render/layers.h>
#include <render/scene/builder.h>
#include <render/scene/visibility.h>

#include <mc/random/pcg.h>
#include <mc/stats/t_test.h>

#include "support/files.h"
#include "support/random_direction.h"
#include "support/traced.h"

namespace {

using namespace render;

Material masked(const Bsdf& bsdf, Mask mask) {
  Material m(bsdf);
  m.mask = std::make_shared<const Mask>(std::move(mask));
  return m;
}
Bsdf gray(double albedo) { return Lambert(Spectrum::Constant(Float(albedo))); }

// Plates of random opacity and orientation across the axis from y = 1 to y = 3, at a random scale and position.
struct Plates {
  double scale;
  Transform space;
  SceneBuilder builder;
  double open = 1; ///< Transmittance of all plates.

  Plates(mc::Pcg& random, int n, double albedo, double most_opaque = 1) {
    scale = std::pow(10, 10 * random.uniform<double>() - 5);
    space = Transform::translate(3 * scale * support::random_axis(random)) *
            Transform::rotate(support::random_axis(random), 360 * random.uniform<double>()) *
            Transform::scale(Vec3d::Constant(scale));
    for (int i = 0; i < n; ++i) {
      const double opacity = most_opaque * random.uniform<double>();
      open *= 1 - double(Float(opacity));
      const Transform turn = Transform::rotate(Vec3d::UnitY(), 360 * random.uniform<double>()) *
                             Transform::rotate(Vec3d::UnitX(), -90 + 10 * random.uniform<double>());
      const Transform place = Transform::translate({0, 1 + (i + 0.5) * 2 / n, 0}) * turn;
      builder.add(TriangleMesh::rectangle(space * place * Transform::scale({20, 20, 1})),
                  {builder.add(masked(gray(albedo), Mask(Float(opacity))))});
    }
  }
  Vec3 point(const Vec3d& p) const { return space.point(p).cast<Float>(); }
  Vec3 direction(const Vec3d& d) const { return space.vector(d).normalized().cast<Float>(); }
};

// t-tests of 20 x 7 means at alpha = 1e-6, fixed seeds.
TEST(Visibility, SkyThroughMasks_MatchesClosedForm) {
  mc::Pcg random(1);
  for (int i = 0; i < 20; ++i) {
    Plates plates(random, 1 + i % 4, 0);
    plates.builder.add(Light(ConstantBackground(Spectrum::Ones())));
    const Scene scene = plates.builder.build();
    const Ray ray{plates.point({0.1, 0, 0.2}), plates.direction({0.1, 1, -0.2})};
    for (const Strategy& s : strategies) {
      // Passed plates add no edges.
      const mc::Moments m = support::traced(scene, ray, {s, 1}, 4000);
      EXPECT_GE(mc::t_test(m, plates.open).p, 1e-6)
          << i << " " << s.name << ": " << m.mean() << " +- " << m.std_error() << ", expected " << plates.open;
    }
  }
}

// Shadow rays to a point light are deterministic: rho / pi I cos / d^2 times the transmittance.
TEST(Visibility, PointLightThroughMasks_MatchesClosedForm) {
  mc::Pcg random(2);
  for (int i = 0; i < 100; ++i) {
    Plates plates(random, i % 8, 0);
    const Vec3d at(random.uniform<double>(), 4, random.uniform<double>());
    plates.builder.add(
        TriangleMesh::rectangle(plates.space * Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({9, 9, 1})),
        {plates.builder.add(gray(0.6))});
    plates.builder.add(
        Light(PointLight(plates.space.point(at), Spectrum::Constant(Float(plates.scale * plates.scale)))));
    const Scene scene = plates.builder.build();
    const double expected = 0.6 / mc::pi<double> * at.y() / std::pow(at.norm(), 3) * plates.open;
    const Ray ray{plates.point({0.3, 0.5, 0.1}), plates.direction({-0.3, -0.5, -0.1})};
    for (const char* strategy : {"nee", "mis"})
      EXPECT_NEAR(support::traced(scene, ray, {strategy_from(strategy), 2}, 4).mean(), expected, 1e-4 * expected)
          << i << " " << strategy << ", scale " << plates.scale;
  }
}

// A spherical light of radiance L above a floor, with a radius of sin a times its distance, causes the radiance rho L
// sin^2 a. Strategies that use hits, connections or both agree. At least 80 of 8000 samples hit the light, enough for a
// t-test. 10 x 7 t-tests at alpha = 1e-6, fixed seeds, with 1e-5 for rounding of positions.
TEST(Visibility, SphereLightThroughMasks_MatchesClosedForm) {
  mc::Pcg random(3);
  for (int i = 0; i < 10; ++i) {
    Plates plates(random, 1 + i % 2, 0, 0.5);
    plates.builder.add(
        TriangleMesh::rectangle(plates.space * Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({9, 9, 1})),
        {plates.builder.add(gray(0.6))});
    const double sine = 0.2 + 0.1 * (i % 2);
    plates.builder.add(Sphere(plates.space.point({0, 5, 0}), 5 * sine * plates.scale),
                       {plates.builder.add(gray(0)), Emission{Spectrum::Constant(2)}});
    const Scene scene = plates.builder.build();
    const double expected = 0.6 * 2 * sine * sine * plates.open;
    const Ray ray{plates.point({0.3, 0.5, 0.1}), plates.direction({-0.3, -0.5, -0.1})};
    for (const Strategy& s : strategies) {
      const mc::Moments m = support::traced(scene, ray, {s, 2}, 8000);
      const bool is_sure = std::abs(m.mean() - expected) <= 1e-5 * expected; // "light" and "nee" hardly vary
      EXPECT_TRUE(is_sure || mc::t_test(m, expected).p >= 1e-6)
          << i << " " << s.name << ": " << m.mean() << " +- " << m.std_error() << ", expected " << expected;
    }
  }
}

// Plates that reflect all light that they stop are invisible in a white sky.
TEST(Visibility, WhiteMasks_VanishInWhiteSky) {
  mc::Pcg random(4);
  for (int i = 0; i < 10; ++i) {
    Plates plates(random, 3, 1);
    plates.builder.add(Light(ConstantBackground(Spectrum::Ones())));
    const Scene scene = plates.builder.build();
    const Ray ray{plates.point({0.1, 0, 0.2}), plates.direction({0.1, 1, -0.2})};
    for (const Strategy& s : strategies) {
      const mc::Moments m = support::traced(scene, ray, {s}, 1000);
      EXPECT_NEAR(m.mean(), 1, 1e-4 + 5 * m.std_error()) << i << " " << s.name;
    }
  }
}

// A checkerboard mask is either opaque or transparent: camera rays, shadows, normals and occlusion are deterministic.
TEST(Visibility, MaskTexture_IsOpaqueOrTransparent) {
  const Spectrum none = Spectrum::Zero(), all = Spectrum::Ones();
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 1})),
              {builder.add(masked(gray(0), Mask(Texture(Checkerboard(all, none)))))});
  builder.add(TriangleMesh::rectangle(Transform::scale({9, 9, 1})), {builder.add(gray(0.5))});
  builder.add(Light(DirectionalLight(Vec3d(0, 0, -1), Spectrum::Constant(Float(mc::pi<double>)))));
  const Scene scene = builder.build();
  EXPECT_TRUE(scene.has_masks());
  mc::Pcg random(5);
  for (int i = 0; i < 200; ++i) {
    const double x = 2 * random.uniform<double>() - 1, y = 2 * random.uniform<double>() - 1;
    const bool there = (x < 0) == (y < 0);
    const Vec3 over(Float(x), Float(y), 2), under(Float(x), Float(y), Float(0.5)), down(0, 0, -1);
    const PathOptions one{strategy_from("nee"), 2};
    EXPECT_NEAR(support::traced(scene, {over, down}, one, 2).mean(), there ? 0 : 0.5, 1e-5);
    EXPECT_NEAR(support::traced(scene, {under, down}, one, 2).mean(), there ? 0 : 0.5, 1e-5);
    std::uint64_t rays = 0;
    Ray ray{over, down};
    const auto hit = nearest_hit(scene, ray, rays, [](Float opacity) { return opacity < 1; });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, there ? 0 : 1);
    EXPECT_EQ(rays, there ? 1u : 2u);
    // A ray that ends before the floor passes a hole and hits nothing.
    Ray cut{over, down, Float(1.5)};
    EXPECT_EQ(nearest_hit(scene, cut, rays, [](Float opacity) { return opacity < 1; }).has_value(), there);
    EXPECT_EQ(shadow_transmittance(scene, {over, down, Float(1.5)}, {}, rays), there ? 0 : 1);
    EXPECT_EQ(shadow_transmittance(scene, {over, down, Float(2.5)}, {}, rays), 0);
  }
}

// A plate of opacity a covers the sky up to 1e-4, so the ambient occlusion below is 1 - a. t-tests at alpha = 1e-6.
TEST(Visibility, AovsThroughMask_MatchClosedForm) {
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 1}) * Transform::scale({1e3, 1e3, 1})),
              {builder.add(masked(gray(0), Mask(Float(0.3))))});
  builder.add(TriangleMesh::rectangle(Transform::scale({1e4, 1e4, 1})), {builder.add(gray(0.5))});
  const Scene scene = builder.build();
  const Ray below{Vec3(0, 0, Float(0.5)), Vec3(0, 0, -1)}, above{Vec3(0, 0, 2), Vec3(1, 0, -10).normalized()};
  EXPECT_NEAR(support::aov_samples(scene, below, Aov::ambient_occlusion, 1000).mean(), 0.7, 1e-4);
  // Plate and floor have the normal +z, and its blue is 1. So the opacity does not matter.
  EXPECT_NEAR(support::aov_samples(scene, above, Aov::normals, 100, 2).mean(), 1, 1e-6);
  // A share of .3 of the rays from above hits the unoccluded plate; the others hit the floor below it.
  const mc::Moments m = support::aov_samples(scene, above, Aov::ambient_occlusion, 20'000);
  EXPECT_GE(mc::t_test(m, 0.3 + 0.7 * 0.7).p, 1e-6) << m.mean() << " +- " << m.std_error();
}

// Layers are deterministic: they show surfaces of opacity 1/2 or more.
TEST(Visibility, Layers_ShowSurfacesOfHalfOpacityOrMore) {
  for (const double opacity : {0.0, 0.49, 0.5, 1.0}) {
    SceneBuilder builder;
    builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 2})),
                {builder.add(masked(gray(0.2), Mask(Float(opacity))))});
    builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 5}) * Transform::scale({9, 9, 1})),
                {builder.add(gray(0.5))});
    LensOptions lens;
    lens.fov = 10;
    builder.set(ThinLens(Transform(), lens));
    const auto l = layers(builder.build(), {1, 1, {0, 0, 1, 1}});
    EXPECT_NEAR(l.at("Z")[0], opacity < 0.5 ? 5 : 2, 1e-5);
    EXPECT_NEAR(l.at("albedo.R")[0], opacity < 0.5 ? 0.5 : 0.2, 1e-6);
    EXPECT_EQ(l.at("id")[0], opacity < 0.5 ? 2 : 1);
  }
}

} // namespace
