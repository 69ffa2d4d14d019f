// Point lights and directional lights above floors and in balls, against closed forms.

#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/traced.h"

namespace {

using namespace render;

constexpr double rho = 0.6;

Vec3d random_direction(mc::Pcg& random) { return mc::UniformSphere<double>{}.sample(random.point<double, 2>()); }

// A floor y = 0 of width 100 in a random space, and a ray that hits its origin.
struct Floor {
  Transform space;
  double scale;
  SceneBuilder builder;
  BsdfId gray;

  explicit Floor(mc::Pcg& random) {
    scale = std::pow(10, 20 * random.uniform<double>() - 10);
    space = Transform::translate(3 * scale * random_direction(random)) *
            Transform::rotate(random_direction(random), 360 * random.uniform<double>()) *
            Transform::scale(Vec3d::Constant(scale));
    gray = builder.add(Lambert(Spectrum::Constant(Float(rho))));
    builder.add(
        TriangleMesh::rectangle(space * Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({50, 50, 50})),
        {gray});
  }
  Ray ray_to(const Vec3d& p) const {
    const Vec3d from = space.point(p + Vec3d(0.1, 1, 0.2)), to = space.point(p);
    return {from.cast<Float>(), (to - from).normalized().cast<Float>()};
  }
};

// rho / pi I cos / d^2 for any position of the light, scale, rotation and translation, up to rounding of coordinates.
TEST(HardShadows, APointOverAFloor) {
  mc::Pcg random(1);
  for (int i = 0; i < 100; ++i) {
    Floor floor(random);
    const Vec3d at = std::pow(10, 2 * random.uniform<double>() - 1) * random_direction(random);
    floor.builder.add(Light(PointLight(floor.space.point(at), Spectrum::Constant(Float(floor.scale * floor.scale)))));
    const Scene scene = floor.builder.build();
    // The ray comes from above; light from below leaves the floor dark.
    const double expected = at.y() > 0 ? rho / mc::pi<double> * at.y() / std::pow(at.norm(), 3) : 0;
    for (const char* strategy : {"nee", "mis"})
      EXPECT_NEAR(support::traced(scene, floor.ray_to(Vec3d::Zero()), {strategy_from(strategy), 2}, 4).mean(), expected,
                  1e-4 / at.squaredNorm())
          << i << " " << strategy << ", scale " << floor.scale;
  }
}

TEST(HardShadows, ParallelLightOnAFloor) {
  mc::Pcg random(2);
  for (int i = 0; i < 100; ++i) {
    Floor floor(random);
    const Vec3d w = random_direction(random);
    floor.builder.add(Light(DirectionalLight(floor.space.vector(-w), Spectrum::Ones())));
    const Scene scene = floor.builder.build();
    for (const char* strategy : {"nee", "mis"})
      EXPECT_NEAR(support::traced(scene, floor.ray_to(Vec3d::Zero()), {strategy_from(strategy), 2}, 4).mean(),
                  rho / mc::pi<double> * std::max(w.y(), 0.0), 1e-4)
          << i << " " << strategy << ", scale " << floor.scale;
  }
}

// A ball between floor and light: the light is fully occluded if its ray passes within the radius, otherwise not.
TEST(HardShadows, DeltaLights_HaveNoPenumbra) {
  mc::Pcg random(3);
  int lit = 0, dark = 0;
  for (int i = 0; i < 400; ++i) {
    Floor floor(random);
    const Vec3d light(0.3, 4, -0.2), ball(0, 1.5, 0);
    const Vec3d p(6 * random.uniform<double>() - 3, 0, 6 * random.uniform<double>() - 3);
    const bool parallel = i % 2 == 0;
    const Vec3d to = parallel ? light.normalized() : Vec3d((light - p).normalized());
    const double miss = ((ball - p) - (ball - p).dot(to) * to).norm(), radius = 0.7;
    if (std::abs(miss / radius - 1) < 1e-3) continue;
    floor.builder.add(Sphere(floor.space.point(ball), radius * floor.scale), {floor.gray});
    if (parallel) floor.builder.add(Light(DirectionalLight(floor.space.vector(-to), Spectrum::Ones())));
    else
      floor.builder.add(
          Light(PointLight(floor.space.point(light), Spectrum::Constant(Float(floor.scale * floor.scale)))));
    const Scene scene = floor.builder.build();
    Ray ray = floor.ray_to(p);
    ray.o += ray.d * Float(0.99 * floor.scale); // starts so near that the ball is not in the way
    const double full = rho / mc::pi<double> * to.y() / (parallel ? 1 : (light - p).squaredNorm());
    const double expected = miss < radius ? 0 : full;
    (miss < radius ? dark : lit)++;
    EXPECT_NEAR(support::traced(scene, ray, {strategy_from("mis"), 2}, 2).mean(), expected, 1e-4 * full) << i;
  }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 30);
}

// Up to two dozen delta lights of both kinds and an area light. Each sample selects one, and the mean is the sum. Six
// t-tests at alpha = 1e-6, fixed seeds.
TEST(HardShadows, ManyLights) {
  for (const int n : {2, 5, 24}) {
    mc::Pcg random(4, std::uint64_t(n));
    Floor floor(random);
    double expected = 0;
    for (int i = 0; i < n; ++i) {
      Vec3d w = random_direction(random);
      w.y() = std::abs(w.y());
      const double d = 1 + 3 * random.uniform<double>(), strength = random.uniform<double>() * (i % 3 == 0 ? 10 : 1);
      expected += rho / mc::pi<double> * strength * w.y() / (i % 2 == 0 ? d * d : 1);
      if (i % 2 == 0)
        floor.builder.add(Light(
            PointLight(floor.space.point(d * w), Spectrum::Constant(Float(strength * floor.scale * floor.scale)))));
      else floor.builder.add(Light(DirectionalLight(floor.space.vector(-w), Spectrum::Constant(Float(strength)))));
    }
    // A spherical light that occludes no other light, straight above and farther than all: L sin^2 a.
    floor.builder.add(Sphere(floor.space.point({0, 40, 0}), 1e-2 * floor.scale),
                      {floor.gray, Emission{Spectrum::Constant(1e6f)}});
    expected += rho * 1e6 * mc::sqr(1e-2 / 40);
    const Scene scene = floor.builder.build();
    for (const char* strategy : {"nee", "mis"}) {
      const mc::Moments m = support::traced(scene, floor.ray_to(Vec3d::Zero()), {strategy_from(strategy), 2}, 20'000);
      EXPECT_GE(mc::t_test(m, expected).p, 1e-6)
          << n << " " << strategy << ": " << m.mean() << " +- " << m.std_error() << ", expected " << expected;
    }
  }
}

// In the middle of a ball of radius R and albedo a the first reflection is a I / (pi R^2). Each further one is a times
// the one before.
TEST(HardShadows, APointInAFurnace) {
  for (const double a : {0.2, 0.5, 0.8}) {
    SceneBuilder builder;
    builder.add(Sphere(Vec3d(1, 2, 3), 2, true), {builder.add(Lambert(Spectrum::Constant(Float(a))))});
    builder.add(Light(PointLight(Vec3d(1, 2, 3), Spectrum::Constant(5))));
    const Scene scene = builder.build();
    const double expected = a * 5 / (mc::pi<double> * 4 * (1 - a));
    for (const char* strategy : {"nee", "mis"}) {
      const mc::Moments m =
          support::traced(scene, {Vec3(2, 2, 3), Vec3(1, 2, 3).normalized()}, {strategy_from(strategy)}, 20'000);
      // Only roulette adds variance.
      EXPECT_NEAR(m.mean(), expected, 1e-4 * expected + 5 * m.std_error()) << strategy << ", albedo " << a;
    }
  }
}

// A flat mirror reflects parallel light onto the floor, in addition to direct light: rho / pi (cos + tint cos'). Boxes
// of glass below the floor, up to more than have a ball each, have no effect. Student's t of 16 images.
TEST(HardShadows, MirrorReflectsDirectionalLight) {
  mc::Pcg random(6);
  for (int i = 0; i < 24; ++i) {
    Floor floor(random);
    Vec3d sun, way; // directions from the origin to the sun and to the mirror
    do sun = random_direction(random);
    while (sun.y() < 0.2);
    do way = random_direction(random);
    while (way.y() < 0.3 || way.y() > 0.8 || way.dot(sun) > 0.7); // outside the camera's view and the sun's rays
    const Vec3d mirror = 2 * way;
    const Float tint = Float(0.5 + 0.5 * random.uniform<double>());
    floor.builder.add(
        TriangleMesh::rectangle(floor.space * Transform::look_at(mirror, mirror + sun - way, random_direction(random)) *
                                Transform::scale(Vec3d::Constant(0.4))),
        {floor.builder.add(FuzzyMetal(Spectrum::Constant(tint)))});
    const BsdfId glass = floor.builder.add(Dielectric());
    for (int box = 0; box < 5 * (i % 3); ++box)
      floor.builder.add(TriangleMesh::box(floor.space * Transform::translate({box - 2.0, -1.5, 0}) *
                                          Transform::scale(Vec3d::Constant(0.3))),
                        {glass});
    floor.builder.add(Light(DirectionalLight(floor.space.vector(-sun), Spectrum::Ones())));
    const Ray ray = floor.ray_to(Vec3d::Zero());
    floor.builder.set(
        ThinLens(Transform::look_at(ray.o.cast<double>(), floor.space.point(Vec3d::Zero()), random_direction(random)),
                 {.fov = 8}));
    const Scene scene = floor.builder.build();
    RenderOptions options;
    options.strategy = strategy_from("mis+lt");
    options.strategy.light_path_rate = 20;
    options.width = options.height = 1;
    options.spp = 512;
    mc::Moments seen;
    for (options.seed = 0; options.seed < 16; ++options.seed)
      seen.add(double(render::render(scene, options).image.pixels[0][0]));
    const double expected = rho / mc::pi<double> * (sun.y() + double(tint) * way.y());
    EXPECT_GE(mc::t_test(seen, expected).p, 1e-6)
        << i << ": " << seen.mean() << " +- " << seen.std_error() << ", not " << expected << ", scale " << floor.scale;
    EXPECT_LE(seen.std_error(), 0.1 * expected) << i;
  }
}

// A scene file that is moved far away is the same scene, with its point lights.
struct MovedLights : support::ScratchTest {};
TEST_F(MovedLights, AreTheSame) {
  for (const double m : {0.0, 1e5, 1e8}) {
    const std::string file = write(
        "moved.xml",
        fmt::format(
            "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"1\"/>"
            "<transform name=\"toWorld\"><lookAt origin=\"{0:.17g}, 1, 0\" target=\"{0:.17g}, 0, 0\" up=\"0, 0, 1\"/>"
            "</transform></sensor><emitter type=\"point\"><point name=\"position\" x=\"{1:.17g}\" y=\"2\" z=\"0\"/>"
            "</emitter><emitter type=\"directional\"><transform name=\"toWorld\"><rotate x=\"1\" angle=\"90\"/>"
            "</transform></emitter><shape type=\"rectangle\"><transform name=\"toWorld\"><rotate x=\"1\" "
            "angle=\"-90\"/><scale value=\"5\"/><translate x=\"{0:.17g}\"/></transform></shape></scene>",
            m, m + 1));
    const Scene scene = read_mitsuba(file).scene;
    const Ray ray = scene.camera().ray(Vec2(Float(0.5), Float(0.5)), scene.camera().tan_half(1), Vec2(0, 0));
    // The point light causes 2 / 5^1.5 and the sun, at normal incidence, 1; the default reflectance is .5. Each sample
    // selects one of the two lights.
    const mc::Moments mean = support::traced(scene, ray, {strategy_from("nee"), 2}, 20'000);
    EXPECT_NEAR(mean.mean(), 0.5 / mc::pi<double> * (1 + 2 / std::pow(5, 1.5)), 5 * mean.std_error()) << m;
    EXPECT_GT(mean.std_error(), 0);
  }
}

TEST(HardShadows, BsdfOnlyStrategies_AreRefused) {
  SceneBuilder builder;
  builder.add(Sphere(Vec3d::Zero(), 1), {builder.add(Lambert())});
  builder.add(Light(PointLight(Vec3d(0, 2, 0), Spectrum::Ones())));
  const Scene scene = builder.build();
  RenderOptions options;
  options.width = options.height = options.spp = 1;
  for (const Strategy& s : strategies) {
    options.strategy = s;
    const bool connects = s.name == "nee" || s.name == "mis" || s.name == "mis+lt";
    EXPECT_EQ(finds_all_lights(scene, s), connects) << s.name;
    const std::string said = support::error_of([&] { render::render(scene, options); });
    if (connects) EXPECT_EQ(said, "");
    else
      EXPECT_EQ(said, fmt::format("render: the strategy {} finds lights by chance, which never meets the scene's point "
                                  "or directional light; use nee or mis",
                                  s.name));
  }
}

} // namespace
