// Absorption in media, against closed forms.

#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/random/pcg.h>
#include <mc/stats/t_test.h>

#include "support/files.h"
#include "support/random_direction.h"
#include "support/traced.h"

namespace {

using namespace render;

const Spectrum white = Spectrum::Ones();

/// A scale and a position of a scene.
struct Space {
  double scale;
  Transform world;

  explicit Space(mc::Pcg& random)
      : scale(std::pow(10, 20 * random.uniform<double>() - 10)),
        world(Transform::translate(3 * scale * support::random_axis(random)) *
              Transform::rotate(support::random_axis(random), 360 * random.uniform<double>()) *
              Transform::scale(Vec3d::Constant(scale))) {}
  Ray ray(const Vec3d& from, const Vec3d& to) const {
    const Vec3d o = world.point(from), e = world.point(to);
    return {o.cast<Float>(), (e - o).normalized().cast<Float>()};
  }
  HomogeneousMedium medium(const Vec3d& sigma) const {
    return HomogeneousMedium((sigma.array() / scale).cast<Float>());
  }
};

TEST(HomogeneousMedium, BeersLaw) {
  const HomogeneousMedium medium(Spectrum(0, Float(0.5), 2));
  for (const double d : {0.0, 1e-6, 0.3, 7.0}) {
    const Spectrum t = medium.transmittance(Float(d));
    EXPECT_EQ(t[0], 1);
    EXPECT_NEAR(t[1], std::exp(-0.5 * d), 1e-6);
    EXPECT_NEAR(t[2], std::exp(-2 * d), 1e-6);
  }
  const Spectrum nothing = medium.transmittance(mc::infinity<Float>);
  EXPECT_EQ(nothing[0], 1);
  EXPECT_EQ(nothing[1], 0);
  EXPECT_EQ(nothing[2], 0);
  for (const Float bad : {Float(-1), mc::infinity<Float>, std::numeric_limits<Float>::quiet_NaN()})
    EXPECT_THAT(support::error_of([&] { HomogeneousMedium(Spectrum(0, bad, 0)); }),
                testing::StartsWith("medium: sigmaA (0, " + fmt::format("{}", bad)));
}

// Boundaries of index 1 neither refract nor reflect. The transmittance is exp(-sigma t) for the distance t inside,
// under every strategy, at any scale and position. The bound is the rounding of coordinates up to four times the
// scene's size.
TEST(HomogeneousMedium, SphereChord_MatchesBeersLaw) {
  mc::Pcg random(1);
  for (int i = 0; i < 100; ++i) {
    const Space space(random);
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(white)));
    const Vec3d sigma(0, random.uniform<double>(), 3 * random.uniform<double>());
    builder.add(Sphere(space.world.point(Vec3d::Zero()), space.scale),
                {.bsdf = builder.add(Dielectric(1)), .interior = space.medium(sigma)});
    const Scene scene = builder.build();
    const double off = 0.99 * random.uniform<double>(), chord = 2 * std::sqrt(1 - off * off);
    for (const Strategy& s : strategies)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(support::traced(scene, space.ray({-2, off, 0}, {0, off, 0}), {s}, 2, c).mean(),
                    std::exp(-sigma[c] * chord), 2e-5)
            << i << " " << s.name << " " << c;
  }
}

// A medium within another medium: the outer one continues beyond the inner one. Roulette makes the radiance vary.
// t-tests of 30 means at alpha = 1e-6, fixed seeds.
TEST(HomogeneousMedium, NestedSpheres_MatchBeersLaw) {
  mc::Pcg random(3);
  for (int i = 0; i < 30; ++i) {
    const Space space(random);
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(white)));
    const BsdfId boundary = builder.add(Dielectric(1));
    const double outer = random.uniform<double>(), inner = 3 * random.uniform<double>();
    for (const auto& [radius, sigma] : {std::pair(1.0, outer), std::pair(0.5, inner)})
      builder.add(Sphere(space.world.point(Vec3d::Zero()), radius * space.scale),
                  {.bsdf = boundary, .interior = space.medium(Vec3d::Constant(sigma))});
    const Scene scene = builder.build();
    const double off = 0.45 * random.uniform<double>(), whole = 2 * std::sqrt(1 - off * off),
                 core = 2 * std::sqrt(0.25 - off * off);
    const mc::Moments m = support::traced(scene, space.ray({-2, off, 0}, {0, off, 0}), {strategy_from("mis")}, 4000);
    const double expected = std::exp(-outer * (whole - core) - inner * core);
    EXPECT_GE(mc::t_test(m, expected).p, 1e-6) << i << ": " << m.mean() << " +- " << m.std_error();
  }
}

// A plate of thickness d and face reflectance R at normal incidence. With e = exp(-sigma d), reflections inside sum to
// the transmittance T = (1 - R)^2 e / (1 - R^2 e^2) and the reflectance R + R e T. The sky is 1 on both sides. t-tests
// of 30 x 7 means at alpha = 1e-6, fixed seeds.
TEST(HomogeneousMedium, APlateOfGlass) {
  mc::Pcg random(2);
  for (int i = 0; i < 30; ++i) {
    const Space space(random);
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(white)));
    const double eta = 1.1 + 2 * random.uniform<double>(), thickness = 0.1 + random.uniform<double>(),
                 sigma = 2 * random.uniform<double>();
    builder.add(TriangleMesh::box(space.world * Transform::scale({50, 50, thickness / 2})),
                {.bsdf = builder.add(Dielectric(Float(eta))), .interior = space.medium(Vec3d::Constant(sigma))});
    const Scene scene = builder.build();
    const double r = mc::sqr((eta - 1) / (eta + 1)), e = std::exp(-sigma * thickness);
    const double through = mc::sqr(1 - r) * e / (1 - mc::sqr(r * e));
    const double expected = through + r + r * e * through;
    for (const Strategy& s : strategies) {
      const mc::Moments m = support::traced(scene, space.ray({0.1, 0.2, 3}, {0.1, 0.2, 0}), {s}, 4000);
      EXPECT_GE(mc::t_test(m, expected).p, 1e-6)
          << i << " " << s.name << ": " << m.mean() << " +- " << m.std_error() << ", expected " << expected;
    }
  }
}

// A shell absorbs only between its two surfaces, which both have the medium. Roulette makes the radiance vary. t-tests
// of 20 means at alpha = 1e-6, fixed seeds.
TEST(HomogeneousMedium, HollowSphere_MatchesBeersLaw) {
  mc::Pcg random(3);
  for (int i = 0; i < 20; ++i) {
    const Space space(random);
    const double inner = 0.3 + 0.6 * random.uniform<double>(), off = random.uniform<double>() * 0.95;
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(white)));
    const BsdfId glass = builder.add(Dielectric(1));
    const auto medium = space.medium(Vec3d::Constant(1.5));
    builder.add(Sphere(space.world.point(Vec3d::Zero()), space.scale), {.bsdf = glass, .interior = medium});
    builder.add(Sphere(space.world.point(Vec3d::Zero()), inner * space.scale, true),
                {.bsdf = glass, .interior = medium});
    const Scene scene = builder.build();
    if (std::abs(off / inner - 1) < 0.01) continue;
    const double hole = off < inner ? 2 * std::sqrt(inner * inner - off * off) : 0;
    const double expected = std::exp(-1.5 * (2 * std::sqrt(1 - off * off) - hole));
    const mc::Moments m = support::traced(scene, space.ray({-2, off, 0}, {0, off, 0}), {}, 4000);
    EXPECT_TRUE(std::abs(m.mean() - expected) <= 5e-5 || mc::t_test(m, expected).p >= 1e-6)
        << i << ": " << m.mean() << " +- " << m.std_error() << ", expected " << expected;
  }
}

// A floor and a point light in a ball of the medium: it absorbs along shadow rays and along camera rays.
TEST(HomogeneousMedium, AbsorbsAlongShadowRays) {
  mc::Pcg random(4);
  for (int i = 0; i < 100; ++i) {
    const Space space(random);
    SceneBuilder builder;
    const double sigma = random.uniform<double>();
    const Vec3d at = Vec3d(random.uniform<double>(), 1 + random.uniform<double>(), random.uniform<double>());
    builder.add(Sphere(space.world.point(Vec3d::Zero()), 4 * space.scale),
                {.bsdf = builder.add(Dielectric(1)), .interior = space.medium(Vec3d::Constant(sigma))});
    builder.add(TriangleMesh::rectangle(space.world * Transform::rotate(Vec3d::UnitX(), -90)),
                {builder.add(Lambert(Spectrum::Constant(Float(0.6))))});
    builder.add(
        Light(PointLight(space.world.point(at), Spectrum::Constant(Float(1)) * Float(space.scale * space.scale))));
    const Scene scene = builder.build();
    const double expected = 0.6 / mc::pi<double> * at.y() / std::pow(at.norm(), 3) * std::exp(-sigma * (at.norm() + 4));
    for (const char* strategy : {"nee", "mis"})
      EXPECT_NEAR(support::traced(scene, space.ray({3, 5, 2}, Vec3d::Zero()), {strategy_from(strategy), 3}, 4).mean(),
                  expected, 1e-4 * expected)
          << i << " " << strategy;
  }
}

// A spherical light above a floor, both inside the medium. Hits and connections lose the same light. Welch's tests of 4
// pairs at alpha = 1e-6.
TEST(HomogeneousMedium, StrategiesAgree) {
  SceneBuilder builder;
  builder.add(Sphere(Vec3d::Zero(), 4), {.bsdf = builder.add(RoughDielectric(Float(1.5), Float(0.4))),
                                         .interior = HomogeneousMedium(Spectrum::Constant(Float(0.4)))});
  const BsdfId gray = builder.add(Lambert(Spectrum::Constant(Float(0.6))));
  builder.add(TriangleMesh::rectangle(Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({2, 2, 1})), {gray});
  builder.add(Sphere(Vec3d(0.3, 1.5, 0), 0.5), {gray, Emission{}});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 9, 0}) * Transform::rotate(Vec3d::UnitX(), 90) *
                                      Transform::scale({4, 4, 1})),
              {gray, Emission{}});
  const Scene scene = builder.build();
  const Ray ray{Vec3(2, 7, 3), Vec3(-2, -7, -3).normalized()};
  const mc::Moments plain = support::traced(scene, ray, {strategy_from("bsdf")}, 100'000);
  EXPECT_GT(plain.mean(), 0);
  for (const char* name : {"hemisphere", "mixture", "nee", "mis"}) {
    const mc::Moments m = support::traced(scene, ray, {strategy_from(name)}, 100'000);
    const double va = mc::sqr(plain.std_error()), vb = mc::sqr(m.std_error());
    const double dof = mc::welch_dof(va, plain.estimate().dof, vb, m.estimate().dof);
    EXPECT_GE(mc::t_test(m.mean() - plain.mean(), std::sqrt(va + vb), dof, 0, 1e-6).p, 1e-6)
        << name << ": " << m.mean() << " +- " << m.std_error() << ", bsdf " << plain.mean() << " +- "
        << plain.std_error();
  }
}

// The camera is in a ball of ink, before or behind a window in the ball, or outside the ball.
TEST(HomogeneousMedium, CameraInsideMedium_MatchesBeersLaw) {
  const HomogeneousMedium ink(Spectrum(Float(0.5), 2, 0));
  for (const double z : {0.4, -0.2, 5.0}) {
    SceneBuilder builder;
    const BsdfId clear = builder.add(Bsdf(Dielectric(1)));
    builder.add(Sphere(Vec3d::Zero(), 1), {.bsdf = clear, .interior = ink});
    builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 0.1})), {clear});
    builder.add(Light(ConstantBackground(white)));
    LensOptions lens;
    lens.fov = 0.01;
    builder.set(ThinLens(Transform::look_at({0, 0, z}, {0, 0, z - 1}, {0, 1, 0}), lens));
    RenderOptions options;
    options.width = options.height = 1;
    options.spp = 16;
    const Spectrum seen = render::render(builder.build(), options).image.at(0, 0);
    const double way = z > 1 ? 2 : z + 1;
    EXPECT_NEAR(seen[0], std::exp(-0.5 * way), 1e-4) << z;
    EXPECT_NEAR(seen[1], std::exp(-2 * way), 1e-4) << z;
    EXPECT_NEAR(seen[2], 1, 1e-4) << z;
  }
}

} // namespace
