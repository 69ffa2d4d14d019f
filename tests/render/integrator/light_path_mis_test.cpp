#include <render/integrator/light_path_mis.h>
#include <render/scene/builder.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

// LightTracer.PlusCameraPaths_MatchesMis tests that the weights of all techniques add up to 1.
namespace {

using namespace render;

/// A grey floor under a lamp, beside a ball of glass that makes light paths pay.
Scene floor_and_lamp() {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert(Spectrum::Constant(Float(0.5))));
  builder.add(TriangleMesh::rectangle(Transform::scale({3, 3, 1})), {gray});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 2}) * Transform::rotate(Vec3d::UnitX(), 180) *
                                      Transform::scale({0.5, 0.5, 1})),
              {gray, Emission{Spectrum::Ones()}});
  builder.add(Sphere(Vec3d(2, 0, 1), 0.5), {builder.add(Dielectric())});
  builder.set(ThinLens(Transform::look_at({0, -3, 1}, {0, 0, 0}, {0, 0, 1}), {.fov = 40}));
  return builder.build();
}

// A path to the lamp has one density of light paths, whether a hit or a connection found it. So the ratios differ by
// the squared densities of these two techniques. Light paths have at least three edges.
TEST(LightPathMis, HitsAndConnections_CompeteWithTheSameLightPaths) {
  const Scene scene = floor_and_lamp();
  const auto light_tracer = LightTracer::create(scene, strategy_from("mis+lt"), 1);
  ASSERT_TRUE(light_tracer);
  const LightPathMis mis(*light_tracer);
  mc::Pcg random(3);
  for (int i = 0; i < 100; ++i) {
    const auto number = [&] { return random.uniform<Float>(); };
    const Vec3 first(number() - 1, number() - 1, 0), second(number(), number(), 0);
    const SurfacePoint lamp = *scene.surfaces()[1].shape->sample_area({number(), number()});
    const Vec3 eye = scene.camera().origin().cast<Float>(), d = (lamp.p - second).normalized();
    SurfacePoint floor;
    floor.ng = floor.ns = Vec3::UnitZ();
    const auto at = [&](const Vec3& p, const Vec3& from) {
      floor.p = p;
      return ShadingPoint<Bsdf>{scene.bsdf(scene.surfaces()[0]), floor, mc::Frame<Float>::from_z(floor.ns),
                                (from - p).normalized()};
    };
    PartialMisWeight partial_mis = mis.start((first - eye).normalized());
    const auto isect = at(first, eye);
    mis.arrive(partial_mis, 1, eye, (first - eye).normalized(), floor);
    LightConnection light{Spectrum::Ones(), 1, Float(0.7), 0, {d, Spectrum::Ones(), 1, lamp}};
    EXPECT_EQ(mis.direct_ratio(partial_mis, 1, isect, light), 0);
    EXPECT_EQ(mis.emission_ratio(partial_mis, 2, 0, &lamp, first, d), 0);

    // A path along the floor would have a cosine of 0, so the second vertex is above it.
    const Vec3 above = second + Vec3(0, 0, Float(0.1)), onward = (above - first).normalized();
    mis.scatter(partial_mis, 1, isect, onward, Float(0.3), 1);
    const auto next = at(above, first);
    mis.arrive(partial_mis, 2, first, onward, floor);
    const Vec3 wi = light.sample.wi = (lamp.p - above).normalized();
    const double by_connection = mis.direct_ratio(partial_mis, 2, next, light);
    const Float pdf = Float(0.2);
    mis.scatter(partial_mis, 2, next, wi, pdf, 1);
    mis.arrive(partial_mis, 3, above, wi, lamp);
    const double by_hit = mis.emission_ratio(partial_mis, 3, 0, &lamp, above, wi);
    EXPECT_GT(by_hit, 0);
    EXPECT_NEAR(by_connection * mc::sqr(double(light.pdf)) / (by_hit * mc::sqr(double(pdf))), 1, 1e-4);
  }
}

} // namespace
