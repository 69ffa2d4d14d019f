#include <render/integrator/path_integrator.h>
#include <render/scene/builder.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/sampler/path_sample_stream.h>
#include <mc/stats/t_test.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/traced.h"

// Radiances with closed forms, traced by every strategy. There are about 50 t-tests at alpha = 1e-5, so correct code
// fails for one seed in 2000. The seeds are fixed.
namespace {

using namespace render;

// All strategies but `light`.
std::vector<Strategy> unbiased_strategies() {
  std::vector<Strategy> found(strategies.begin(), strategies.end());
  std::erase_if(found, [](const Strategy& s) { return s.name == "light"; });
  return found;
}
const std::vector<Strategy> unbiased = unbiased_strategies();

/// Horizontal rectangle at height y about (cx, cz), normal up or down.
Shape horizontal(double cx, double y, double cz, double half_x, double half_z, bool up) {
  return TriangleMesh::rectangle(Transform::columns(Vec3d(half_x, 0, 0), Vec3d(0, 0, up ? -half_z : half_z),
                                                    Vec3d(0, up ? 1 : -1, 0), Vec3d(cx, y, cz)));
}

// Constant samples must equal the mean up to float rounding; other samples pass a t-test.
void expect_mean(const mc::Moments& m, double value, const std::string& what, double rounding = 1e-5) {
  if (m.std_error() <= rounding * std::abs(value) / 10) {
    EXPECT_NEAR(m.mean(), value, rounding * std::abs(value)) << what;
    return;
  }
  const auto test = mc::t_test(m, value);
  EXPECT_GE(test.p, 1e-5) << what << ": " << m.mean() << " +- " << m.std_error() << ", expected " << value;
}

std::string word(const Strategy& s) { return std::string(s.name); }

// Inside a closed sphere of emission e and albedo a, radiance is e / (1 - a) everywhere, for any number of branches.
TEST(PathIntegrator, ClosedFurnace) {
  SceneBuilder builder;
  const BsdfId wall = builder.add(Lambert(Spectrum(Float(0.2), Float(0.5), Float(0.8))));
  builder.add(Sphere(Vec3d::Zero(), 1, true), {wall, Emission{Spectrum::Constant(2)}});
  const Scene scene = builder.build();
  const Ray ray{Vec3(Float(0.2), Float(0.1), Float(-0.3)), Vec3(1, 2, 3).normalized()};
  for (const Strategy& s : unbiased)
    for (int channel = 0; channel < 3; ++channel)
      expect_mean(support::traced(scene, ray, {s}, 5'000, channel), 2 / (1 - (0.2 + 0.3 * channel)), word(s));
  for (const int branches : {1, 5})
    expect_mean(support::traced(scene, ray, {unbiased[0], -1, branches}, 5'000), 2.5, "branches");
}

// A lossless sphere or plate in a constant sky of 1 is invisible.
TEST(PathIntegrator, WhiteFurnace_HidesObjects) {
  for (const Bsdf& bsdf : {Bsdf(Lambert(Spectrum::Ones())), Bsdf(FuzzyMetal(Spectrum::Ones())), Bsdf(Dielectric())}) {
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(Spectrum::Ones())));
    builder.add(Sphere(Vec3d::Zero(), 1), {builder.add(bsdf)});
    const Scene scene = builder.build();
    // Glass varies only if roulette ends a path. 2 in 1000 paths reflect twice inside, too few for a t-test. The
    // standard error is sqrt(.002 * .05 / n) = 7e-5.
    for (const Strategy& s : unbiased) {
      const mc::Moments m = support::traced(scene, {Vec3(Float(0.3), Float(0.4), 3), Vec3(0, 0, -1)}, {s}, 20'000);
      if (bsdf.lobes().is_delta()) EXPECT_NEAR(m.mean(), 1, 5e-4) << word(s);
      else expect_mean(m, 1, word(s), 1e-4);
    }
  }
}

// The Cornell light above the middle of the floor: the form factor of parallel rectangles is 0.013945466356.
Scene cornell_light() {
  SceneBuilder builder;
  const BsdfId white = builder.add(Lambert(Spectrum::Constant(Float(0.73))));
  builder.add(horizontal(278, 0, 279.5, 1000, 1000, true), {white});
  builder.add(horizontal(278, 554, 279.5, 65, 52.5, false), {white, Emission{Spectrum::Constant(15)}});
  return builder.build();
}

TEST(PathIntegrator, RectangleOverLambertPlane) {
  const Scene scene = cornell_light();
  const Ray down{Vec3(278, 100, Float(279.5)), Vec3(0, -1, 0)};
  for (const Strategy& s : strategies)
    expect_mean(support::traced(scene, down, {s, 2}, 100'000), 15 * 0.73 * 0.013945466356, word(s));
}

TEST(PathIntegrator, LightsAreDarkFromBehind) {
  const Scene scene = cornell_light();
  std::uint64_t rays = 0;
  for (const Strategy& s : unbiased) {
    const mc::IndependentPairs numbers(1, 0);
    mc::IndependentPathStream<Float> stream(numbers, 0);
    const PathIntegrator<Scene> integrator(scene, {s, 1});
    const Ray above{Vec3(278, 700, Float(279.5)), Vec3(0, -1, 0)}, below{Vec3(278, 300, Float(279.5)), Vec3(0, 1, 0)};
    EXPECT_TRUE(is_black(integrator.Li(above, stream, rays))) << word(s);
    EXPECT_TRUE((integrator.Li(below, stream, rays) == 15).all()) << word(s);
  }
}

// A sphere of radius r and radiance L at height h above a plane causes the irradiance pi L r^2 / h^2 below it.
TEST(PathIntegrator, SphereOverLambertPlane) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(horizontal(0, 0, 0, 50, 50, true), {gray});
  builder.add(Sphere(Vec3d(0, 4, 0), 1.5), {gray, Emission{Spectrum::Constant(3)}});
  const Scene scene = builder.build();
  const Ray down{Vec3(0, 1, 0), Vec3(0, -1, 0)};
  for (const Strategy& s : strategies)
    expect_mean(support::traced(scene, down, {s, 2}, 100'000), 0.5 * 3 * 1.5 * 1.5 / 16, word(s));
}

// Emission after a delta lobe counts fully and once in every strategy. The next-event estimation of CMU 15-468 (2021)
// had the opposite bugs.
TEST(PathIntegrator, LightsInMirrorsAndThroughGlass) {
  const Emission light{Spectrum::Constant(3)};
  SceneBuilder builder;
  builder.add(horizontal(0, 0, 0, 5, 5, true), {builder.add(FuzzyMetal(Spectrum::Constant(Float(0.8))))});
  builder.add(horizontal(0, 5, 0, 1, 1, false), {builder.add(Lambert(Spectrum::Zero())), light});
  const Scene mirror = builder.build();
  // At normal incidence a glass plate transmits (1 - R) / (1 + R) with R = .04, including all inner reflections.
  const Transform flat = Transform::columns(Vec3d(2, 0, 0), Vec3d(0, 0.5, 0), Vec3d(0, 0, 2), Vec3d(0, 2, 0));
  builder.add(TriangleMesh::box(flat), {builder.add(Dielectric())});
  builder.add(horizontal(0, 5, 0, 1, 1, false), {builder.add(Lambert(Spectrum::Zero())), light});
  const Scene plate = builder.build();
  for (const Strategy& s : strategies) {
    expect_mean(support::traced(mirror, {Vec3(0, 2, 0), Vec3(Float(0.1), -2, 0).normalized()}, {s}, 10), 0.8 * 3,
                word(s));
    expect_mean(support::traced(plate, {Vec3(0, 0, 0), Vec3(0, 1, 0)}, {s}, 40'000), 3 * 0.96 / 1.04, word(s));
  }
}

// Rough glass scatters to both sides. Each strategy agrees with `bsdf` within 5 standard errors: alpha = 6e-7.
TEST(PathIntegrator, EveryStrategySeesThroughGroundGlass) {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  builder.add(horizontal(0, 0, 0, 5, 5, true), {builder.add(RoughDielectric(Float(1.5), Float(0.5)))});
  builder.add(horizontal(0, 9, 0, 1, 1, false), {builder.add(Lambert()), Emission{}});
  const Scene scene = builder.build();
  const Ray ray{Vec3(1, 2, 0), Vec3(Float(-0.5), -1, 0).normalized()};
  const mc::Moments followed = support::traced(scene, ray, {strategy_from("bsdf"), 2}, 100'000);
  EXPECT_GT(followed.mean(), 0.3); // refraction divides radiance by 1.5^2
  for (const Strategy& s : unbiased) {
    const mc::Moments m = support::traced(scene, ray, {s, 2}, 100'000);
    EXPECT_LE(std::abs(m.mean() - followed.mean()), 5 * std::hypot(m.std_error(), followed.std_error())) << word(s);
  }
}

// Light bounces dozens of times in a ball of rough glass, or in a white room. The scene has balls of glass as targets,
// one with a lamp inside. If a few paths carried the light, the variance would grow or the light would be missed. The
// bound is 5 standard errors: alpha = 6e-7.
TEST(PathIntegrator, Guiding_KeepsVarianceLowForManyBounces) {
  for (const bool room : {false, true}) {
    SceneBuilder builder;
    builder.add(Light(ConstantBackground(Spectrum::Ones())));
    if (room) {
      const Emission light{Spectrum::Constant(Float(0.05)), false};
      builder.add(Sphere(Vec3d::Zero(), 1, true), {builder.add(Lambert(Spectrum::Constant(Float(0.95)))), light});
      builder.add(Sphere(Vec3d(0, 0.5, 0), 0.2), {builder.add(Dielectric())});
    } else builder.add(Sphere(Vec3d::Zero(), 1), {builder.add(RoughDielectric(Float(1.5), Float(0.03)))});
    builder.add(Sphere(Vec3d(0, 9, 0), 1), {builder.add(Dielectric())});
    builder.add(Sphere(Vec3d(0, 9, 0), 0.5), {builder.add(Lambert()), Emission{}});
    const Scene scene = builder.build();
    const Ray along{Vec3(0, 0, Float(-0.9)), Vec3(1, 0, 0)};
    const mc::Moments followed = support::traced(scene, along, {strategy_from("bsdf")}, 20'000);
    EXPECT_GT(followed.mean(), 0.5);
    for (const GuidingTarget target : {GuidingTarget::speculars, GuidingTarget::enclosing_speculars}) {
      const Strategy s = {"", target, Float(0.25), DirectLighting::mis};
      const mc::Moments m = support::traced(scene, along, {s}, 20'000);
      EXPECT_LE(std::abs(m.mean() - followed.mean()), 5 * std::hypot(m.std_error(), followed.std_error())) << room;
      EXPECT_LE(m.variance(), (room ? 10 : 2) * followed.variance()) << room;
    }
  }
}

// No strategy connects near-specular glass to lights that rays can hit. Lights that only connections find still count.
TEST(PathIntegrator, NearSpecularLobe_FindsEveryLight) {
  const RoughDielectric narrow(Float(1.5), Float(1e-4));
  ASSERT_TRUE(narrow.lobes().is_near_specular());
  const Ray down{Vec3(0, 2, 0), Vec3(0, -1, 0)};
  SceneBuilder sky;
  sky.add(Light(ConstantBackground(Spectrum::Constant(Float(0.5)))));
  sky.add(horizontal(0, 5, 0, 1, 1, false), {sky.add(Lambert()), Emission{Spectrum::Constant(3)}});
  sky.add(horizontal(0, 0, 0, 9, 9, true), {sky.add(narrow)});
  const Scene open = sky.build();
  // At normal incidence the light above reflects with ((1.5 - 1) / (1.5 + 1))^2. The sky below is transmitted, with
  // radiance divided by the squared index.
  for (const Strategy& s : unbiased)
    expect_mean(support::traced(open, down, {s, 2}, 20'000), 3 * 0.04 + 0.5 * 0.96 / (1.5 * 1.5), word(s), 1e-4);

  SceneBuilder dark;
  dark.add(Light(PointLight(Vec3d(0, 5, 0), Spectrum::Constant(1))));
  dark.add(horizontal(0, 0, 0, 9, 9, true), {dark.add(narrow)});
  const Scene lamp = dark.build();
  // D at the facet normal is 1 / (pi alpha^2): the result is F D / 4 times 1 / 5^2.
  const double peak = 0.04 / (4 * mc::pi<double> * 1e-8) / 25;
  for (const char* s : {"nee", "mis"})
    expect_mean(support::traced(lamp, down, {strategy_from(s), 2}, 10), peak, s, 1e-3);
}

// Two lights, sky, glass and fuzzy metal. All strategies agree with mis, except `light`, which misses reflected light.
TEST(PathIntegrator, StrategiesAgree) {
  SceneBuilder builder;
  const BsdfId tan = builder.add(Lambert(Spectrum(Float(0.8), Float(0.6), Float(0.4)))),
               metal = builder.add(FuzzyMetal(Spectrum::Constant(Float(0.9)), Float(0.6))),
               glass = builder.add(Dielectric());
  builder.add(Light(GradientBackground()));
  builder.add(horizontal(0, 0, 0, 4, 4, true), {tan});
  builder.add(Sphere(Vec3d(1.2, 1, 0), 1), {metal});
  builder.add(Sphere(Vec3d(-1.2, 1, 0), 1), {.bsdf = glass, .importance_target = true});
  builder.add(horizontal(0, 4, 0, 1.5, 1.5, false), {tan, Emission{Spectrum(4, 3, 2)}});
  builder.add(Sphere(Vec3d(0, 0.6, 1.5), 0.5), {tan, Emission{Spectrum(1, 2, 3)}});
  const Scene scene = builder.build();
  const Ray ray{Vec3(Float(0.1), 2, 5), Vec3(0, -2, -4).normalized()};
  const mc::Moments mis = support::traced(scene, ray, {strategy_from("mis")}, 60'000);
  for (const Strategy& s : unbiased) {
    const mc::Moments other = support::traced(scene, ray, {s}, 60'000);
    const double error = std::hypot(mis.std_error(), other.std_error());
    EXPECT_LE(std::abs(other.mean() - mis.mean()), 4.42 * error)
        << word(s) << ": " << other.mean() << " against " << mis.mean();
  }
  const mc::Moments light = support::traced(scene, ray, {strategy_from("light")}, 60'000);
  EXPECT_LE(light.mean(), mis.mean() - 10 * std::hypot(mis.std_error(), light.std_error()));
}

// A floor beside a wall. If misses_light() is true, `light` is too dark by far more than its error; otherwise it is
// right.
TEST(PathIntegrator, LightStrategy_MissesLightAsStated) {
  for (const bool lamp : {false, true})
    for (const bool sky : {false, true})
      for (const int depth : {1, 2, 3, -1}) {
        SceneBuilder builder;
        const BsdfId white = builder.add(Lambert(Spectrum::Constant(Float(0.7))));
        builder.add(horizontal(0, 0, 0, 4, 4, true), {white});
        builder.add(Sphere(Vec3d(-2, 1.5, 0), 1.5), {white});
        if (lamp) builder.add(Sphere(Vec3d(0, 4, 0), 0.5), {white, Emission{Spectrum::Constant(9)}});
        if (sky) builder.add(Light(ConstantBackground(Spectrum::Ones())));
        const Scene scene = builder.build();
        const Ray ray{Vec3(0, 2, 3), Vec3(0, -2, -3).normalized()};
        const Strategy& strategy = strategy_from("light");
        const mc::Moments light = support::traced(scene, ray, {strategy, depth}, 20'000),
                          mis = support::traced(scene, ray, {strategy_from("mis"), depth}, 20'000);
        const double error = std::hypot(light.std_error(), mis.std_error());
        const std::string what = fmt::format("lamp {}, sky {}, depth {}", lamp, sky, depth);
        EXPECT_EQ(misses_light(scene, strategy, depth), lamp && (depth == -1 || depth == 3 || (sky && depth == 2)))
            << what;
        if (misses_light(scene, strategy, depth)) EXPECT_LE(light.mean(), mis.mean() - 10 * error) << what;
        else EXPECT_LE(std::abs(light.mean() - mis.mean()), 4.42 * error + 1e-5) << what;
        for (const Strategy& other : unbiased) EXPECT_FALSE(misses_light(scene, other, depth)) << word(other);
      }
}

// The radiance of paths with at most `depth` edges is the partial sum of the series; 0 edges give 0.
TEST(PathIntegrator, DepthCountsEdges) {
  SceneBuilder builder;
  const BsdfId wall = builder.add(Lambert(Spectrum::Constant(Float(0.9))));
  builder.add(Sphere(Vec3d::Zero(), 1, true), {wall, Emission{}});
  const Scene scene = builder.build();
  const Ray ray{Vec3::Zero(), Vec3::UnitX()};
  for (const Strategy& s : unbiased) EXPECT_EQ(support::traced(scene, ray, {s, 0}, 10).mean(), 0) << word(s);
  for (const int depth : {1, 2, 3, 40})
    for (const Strategy& s : unbiased)
      expect_mean(support::traced(scene, ray, {s, depth}, 10'000), (1 - std::pow(0.9, depth)) / 0.1,
                  word(s) + " to depth " + std::to_string(depth), 2e-5);
}

// A scene with one BSDF for all surfaces, which a test supplies.
template <class B> struct Recovered : Scene {
  B own;
  Recovered(Scene scene, B bsdf) : Scene(std::move(scene)), own(std::move(bsdf)) {}
  const B& bsdf(const Surface&) const { return own; }
  const B& bsdf(const Surface&, const Hit&, const SurfacePoint&, std::optional<Bsdf>&, Float) const { return own; }
};

// Lambert with a NaN in one component.
struct Broken : Lambert {
  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    auto s = Lambert::sample(wo, uc, u);
    if (s) s->f[1] = std::numeric_limits<Float>::quiet_NaN();
    return s;
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    Spectrum f = Lambert::eval(wo, wi);
    if (!is_black(f)) f[1] = std::numeric_limits<Float>::quiet_NaN();
    return f;
  }
};

// The back of a one-sided flat light is black, for any rounding of its points.
TEST(PathIntegrator, OneSidedLight_IsDarkBehind) {
  mc::Pcg random(3);
  const auto direction = [&] { return mc::UniformSphere<double>{}.sample(random.point<double, 2>()); };
  for (int i = 0; i < 200; ++i) {
    SceneBuilder builder;
    const Transform world = Transform::translate(10 * direction()) * Transform::rotate(direction(), 77);
    builder.add(TriangleMesh::rectangle(world), {builder.add(Lambert(Spectrum::Constant(Float(0.5)))), Emission{}});
    const Scene scene = builder.build();
    const Vec3d from = world.point({0.1, 0.2, -3}), to = world.point({-0.3, 0.4, 0});
    const Ray ray{from.cast<Float>(), (to - from).normalized().cast<Float>()};
    for (const Strategy& s : unbiased)
      EXPECT_EQ(support::traced(scene, ray, {s}, 16).mean(), 0) << word(s) << ", turn " << i;
  }
}

// A NaN throughput ends a path of any length as an invalid sample; roulette must not hide it.
TEST(PathIntegrator, NonFiniteThroughput_IsReported) {
  SceneBuilder builder;
  builder.add(Sphere(Vec3d::Zero(), 1, true), {builder.add(Lambert())});
  const Recovered<Broken> scene(builder.build(), Broken());
  std::uint64_t rays = 0;
  for (const Strategy& s : unbiased) {
    const PathIntegrator<Recovered<Broken>> integrator(scene, {s});
    for (std::uint32_t i = 0; i < 100; ++i) {
      const mc::IndependentPairs numbers(3, 0);
      mc::IndependentPathStream<Float> stream(numbers, i);
      EXPECT_FALSE(integrator.Li({Vec3::Zero(), Vec3::UnitX()}, stream, rays).isFinite().all()) << word(s);
    }
  }
}

// A BSDF with a mirror lobe under half of the light, and Lambert. 30 % of the samples take the mirror, which reflects
// .8.
class Coated {
 public:
  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    const auto lobe = mc::Bernoulli<Float>(Float(0.3)).sample_index(uc);
    if (lobe.index == 1)
      return BsdfSample{reflect(wo), Spectrum::Constant(Float(0.24) / std::abs(wo.z())), lobe.pmf, true};
    auto s = base_.sample(wo, 0, u);
    if (s) s->pdf *= lobe.pmf;
    return s;
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const { return base_.eval(wo, wi); }
  Float pdf(const Vec3& wo, const Vec3& wi) const { return Float(0.7) * base_.pdf(wo, wi); }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return Float(0.8); }
  Lobes lobes() const { return {.roughness = 1, .has_delta = true}; }

 private:
  Lambert base_{Spectrum::Constant(Float(0.35))};
};

// Inside a closed sphere of this BSDF with emission 2, radiance is 2 / (1 - .59). Every strategy must count the mirror
// lobe once.
TEST(PathIntegrator, MixedDeltaAndRoughLobes_ConserveEnergyInFurnace) {
  SceneBuilder builder;
  builder.add(Sphere(Vec3d::Zero(), 1, true), {builder.add(Lambert()), Emission{Spectrum::Constant(2)}});
  const Recovered<Coated> scene(builder.build(), Coated());
  const Ray ray{Vec3(Float(0.2), Float(0.1), Float(-0.3)), Vec3(1, 2, 3).normalized()};
  for (const Strategy& s : unbiased) expect_mean(support::traced(scene, ray, {s}, 20'000), 2 / (1 - 0.59), word(s));
}

// Two lights, a ball that `mis` aims at, and an importance target: all strategies agree with `bsdf`.
TEST(PathIntegrator, MixedDeltaAndRoughLobes_StrategiesAgree) {
  SceneBuilder builder;
  const BsdfId any = builder.add(Lambert()), glass = builder.add(Dielectric());
  builder.add(Light(ConstantBackground(Spectrum::Constant(Float(0.1)))));
  builder.add(horizontal(0, 0, 0, 4, 4, true), {any});
  builder.add(Sphere(Vec3d(1.2, 1, 0), 1), {glass});
  builder.add(Sphere(Vec3d(-1.2, 1, 0), 1), {.bsdf = any, .importance_target = true});
  builder.add(horizontal(0, 4, 0, 1.5, 1.5, false), {any, Emission{Spectrum::Constant(4)}});
  builder.add(Sphere(Vec3d(0, 0.6, 1.5), 0.5), {any, Emission{}});
  const Recovered<Coated> scene(builder.build(), Coated());
  const Ray ray{Vec3(Float(0.1), 2, 5), Vec3(0, -2, -4).normalized()};
  const mc::Moments expected = support::traced(scene, ray, {strategy_from("bsdf")}, 100'000);
  for (const Strategy& s : unbiased) {
    const mc::Moments m = support::traced(scene, ray, {s}, 50'000);
    EXPECT_LE(std::abs(m.mean() - expected.mean()), 4.42 * std::hypot(m.std_error(), expected.std_error()))
        << word(s) << ": " << m.mean() << " against " << expected.mean();
  }
}

TEST(RadianceContribution, WeightedByMisRatio) {
  EXPECT_EQ(RadianceContribution{Spectrum::Constant(6)}.weighted()[1], 6);
  EXPECT_EQ((RadianceContribution{Spectrum::Constant(6), 2}.weighted()[1]), 2);
  EXPECT_EQ((RadianceContribution{Spectrum::Constant(6), mc::infinity<double>}.weighted()[1]), 0);
}

// The survivors' weight keeps the mean. The first edges always survive.
TEST(PathIntegrator, RouletteKeepsTheMean) {
  const mc::IndependentPairs numbers(11, 0);
  mc::IndependentPathStream<Float> stream(numbers, 1);
  const auto beta_after = [&](int edges, Float beta, Float eta_scale) {
    PathIntegrator<Scene>::PathState state;
    state.edges = edges;
    state.beta = Spectrum::Constant(beta);
    state.eta_scale = eta_scale;
    return PathIntegrator<Scene>::russian_roulette(state, stream) ? double(state.beta[0]) : 0;
  };
  EXPECT_EQ(beta_after(3, Float(1e-6), 1), double(Float(1e-6)));
  for (const Float eta_scale : {Float(1), Float(0.25)}) {
    mc::Moments moments, survivors;
    for (int i = 0; i < 20'000; ++i) {
      const double beta = beta_after(5, Float(0.1), eta_scale);
      moments.add(beta);
      survivors.add(beta > 0);
    }
    EXPECT_NEAR(moments.mean(), 0.1, 4.5 * moments.std_error());
    EXPECT_NEAR(survivors.mean(), 4 * 0.1 * double(eta_scale), 4.5 * survivors.std_error());
  }
}

} // namespace
