#include <render/integrator/direction_mixture.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/path_sample_stream.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// A floor under a lamp, a glass ball and an importance target. None of these occludes another.
Scene small_scene() {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert()), glass = builder.add(Dielectric());
  builder.add(Sphere(Vec3d(0, 3, 0), 1), {gray, Emission{}});
  builder.add(Sphere(Vec3d(3, 1, 0), 0.8), {glass});
  builder.add(Sphere(Vec3d(-3, 1, 0), 0.8), {.bsdf = gray, .importance_target = true});
  return builder.build();
}

SurfacePoint of_floor() {
  SurfacePoint point;
  point.p = Vec3(0, 0, 0);
  point.ng = point.ns = Vec3::UnitY();
  return point;
}

// Half mirror, half Lambert. The mirror reports entry into a denser medium.
class HalfMirror {
 public:
  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    if (mc::Bernoulli<Float>(Float(0.5)).sample_index(uc).index == 1)
      return BsdfSample{reflect(wo), Spectrum::Constant(Float(0.5) / std::abs(wo.z())), Float(0.5), true, Float(1.5)};
    auto s = base_.sample(wo, 0, u);
    if (s) s->pdf /= 2;
    return s;
  }
  Spectrum eval(const Vec3& wo, const Vec3& wi) const { return base_.eval(wo, wi); }
  Float pdf(const Vec3& wo, const Vec3& wi) const { return base_.pdf(wo, wi) / 2; }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return Float(0.75); }
  Lobes lobes() const { return {.roughness = 1, .has_delta = true}; }

 private:
  Lambert base_;
};

// Compares the share of samples without delta lobes with the integral of pdf() over the sphere. The standard error of
// the share is below .5 / sqrt(n), and the error of the integral is below the error of the balls' densities. The bound
// is 6 of both together. Each sample without a delta lobe has the density pdf(), up to rounding at outlines.
template <class B> void expect_consistent(const B& bsdf, const Strategy& strategy, double delta_share) {
  const Scene scene = small_scene();
  const DirectionMixture directions(scene, strategy);
  const SurfacePoint point = of_floor();
  const auto frame = mc::Frame<Float>::from_z(point.ns);
  const ShadingPoint<B> at{bsdf, point, frame.to_world(Vec3(1, 0, 2).normalized())};
  const int n = 20'000;
  int rough = 0, delta = 0, other = 0;
  for (int i = 0; i < n; ++i) {
    const mc::IndependentPairs numbers(11, 0);
    mc::IndependentPathStream<Float> stream(numbers, std::uint32_t(i));
    const auto one = directions.sample(at, stream);
    if (!one) continue;
    if (one->pdf == 0) {
      ++delta;
      EXPECT_EQ(one->eta, Float(1.5)) << strategy.name;
      continue;
    }
    ++rough;
    other += std::abs(directions.pdf(at, frame.to_local(one->d), one->d) / one->pdf - 1) > Float(1e-3);
  }
  EXPECT_LE(other, n / 1000) << strategy.name;
  EXPECT_NEAR(double(delta) / n, delta_share, 6 * 0.5 / std::sqrt(n)) << strategy.name;
  mc::Moments integral;
  mc::Pcg random(5);
  for (int i = 0; i < 200'000; ++i) {
    const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    integral.add(4 * mc::pi<double> * double(directions.pdf(at, frame.to_local(d), d)));
  }
  EXPECT_NEAR(double(rough) / n, integral.mean(), 6 * (0.5 / std::sqrt(n) + integral.std_error())) << strategy.name;
}

TEST(DirectionMixture, PdfIntegratesToSampledFraction) {
  for (const Strategy& s : strategies) expect_consistent(Lambert(), s, 0);
}

TEST(DirectionMixture, DeltaLobe_IsSampledByBsdfOnly) {
  for (const Strategy& s : strategies) {
    const double followed = s.guiding_target == GuidingTarget::none ? 1 : 1 - std::min(double(s.guiding_fraction), 0.5);
    expect_consistent(HalfMirror(), s, 0.5 * followed);
  }
}

// BSDF samples and target samples: the lamps lie above a floor of rough glass, which is sampled from both sides.
TEST(DirectionMixture, TransmittedSample_HasTransmittedEta) {
  const Scene scene = small_scene();
  const RoughDielectric glass(Float(1.5), Float(0.3));
  const SurfacePoint point = of_floor();
  const auto frame = mc::Frame<Float>::from_z(point.ns);
  for (const Strategy& s : strategies) {
    const DirectionMixture directions(scene, s);
    for (const Float side : {Float(1), Float(-1)}) {
      const ShadingPoint<RoughDielectric<>> at{glass, point, frame.to_world(Vec3(1, 0, 2 * side).normalized())};
      const Float across = side > 0 ? Float(1.5) : 1 / Float(1.5);
      int crossing = 0;
      for (std::uint32_t i = 0; i < 1000; ++i) {
        const mc::IndependentPairs numbers(12, 0);
        mc::IndependentPathStream<Float> stream(numbers, i);
        const auto one = directions.sample(at, stream);
        if (!one) continue;
        const bool crosses = frame.to_local(one->d).z() * side < 0;
        crossing += crosses;
        EXPECT_EQ(one->eta, crosses ? across : Float(1)) << s.name << " from side " << side;
      }
      EXPECT_GE(crossing, side < 0 ? 100 : 0) << s.name;
    }
  }
}

// Only the glass ball that overlaps the lamp is a target; there is none if the lamp stands apart.
TEST(DirectionMixture, EnclosingSpeculars_ContainLights) {
  const Strategy shades = {"", GuidingTarget::enclosing_speculars, Float(0.5), DirectLighting::mis};
  for (const double x : {3.0, 3.9, 5.0}) {
    SceneBuilder builder;
    const BsdfId grey = builder.add(Lambert()), glass = builder.add(Dielectric());
    builder.add(Sphere(Vec3d(x, 1, 0), 0.2), {grey, Emission{}});
    builder.add(Sphere(Vec3d(3, 1, 0), 0.8), {glass});
    builder.add(Sphere(Vec3d(-3, 1, 0), 0.8), {glass});
    const Scene scene = builder.build();
    const DirectionMixture directions(scene, shades);
    const SurfacePoint point = of_floor();
    const Lambert floor;
    const ShadingPoint<Lambert> at{floor, point, point.ng};
    const auto guiding_pdf_ratio = [&](const Vec3& towards) {
      const Vec3 wi = at.frame.to_local(towards.normalized());
      return directions.pdf(at, wi, towards.normalized()) / floor.pdf(at.wo, wi);
    };
    const bool reaches = x < 4;
    EXPECT_EQ(guiding_pdf_ratio({3, 1, 0}) > 2, reaches) << x;
    EXPECT_NEAR(guiding_pdf_ratio({-3, 1, 0}), reaches ? 0.5 : 1, 1e-5) << x;
  }
}

// Rounding makes rays miss the outline of a tiny lamp; each miss loses light. Spheres and their densities use the same
// arithmetic, so no ray misses. Triangles are first tested in float, and a share of 1.87e-4 of the rays misses. The
// bound of 34 misses in 100,000 rays is 3.6 binomial standard deviations above the mean: alpha = 2e-4.
TEST(DirectionMixture, TinyAreaLights_AreHitBySampledRays) {
  const double half = 1e-5;
  const Vec3d place(0.4, 0.8, -0.3);
  const auto misses = [&](auto lamp) {
    SceneBuilder builder;
    builder.add(std::move(lamp), {builder.add(Lambert()), Emission{.two_sided = true}});
    const Scene scene = builder.build();
    const DirectionMixture directions(scene, strategy_from("light"));
    const Lambert white;
    int missed = 0;
    for (int i = 0; i < 100'000; ++i) {
      const mc::IndependentPairs numbers(7, 0);
      mc::IndependentPathStream<Float> stream(numbers, std::uint32_t(i));
      SurfacePoint point = of_floor();
      const Vec2 u = stream.next2();
      point.p = Vec3(u[0] - Float(0.5), 0, u[1] - Float(0.5));
      point.error = std::numeric_limits<Float>::epsilon() * point.p.lpNorm<Eigen::Infinity>();
      const auto one = directions.sample(ShadingPoint<Lambert>{white, point, point.ng}, stream);
      missed += !one || !scene.intersect(point.spawn_ray(one->d));
    }
    return missed;
  };
  EXPECT_EQ(misses(Sphere(place, half)), 0);
  const Transform down =
      Transform::translate(place) * Transform::rotate(Vec3d::UnitX(), 90) * Transform::scale(Vec3d::Constant(half));
  EXPECT_LE(misses(TriangleMesh::rectangle(down)), 34);
}

} // namespace
