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
    const Vec3 eye = scene.camera().origin().cast<Float>(), first(number() - 1, number() - 1, 0),
               second(number(), number(), Float(0.1));
    const SurfacePoint lamp = *scene.surfaces()[1].shape->sample_area({number(), number()});
    const Vec3 d0 = (first - eye).normalized(), d1 = (second - first).normalized(), d2 = (lamp.p - second).normalized();
    // A vertex at p with directions to both of its neighbours on the side of its normal.
    const auto point_between = [](const Vec3& p, const Vec3& to_previous, const Vec3& to_next) {
      SurfacePoint point;
      point.p = p;
      point.ng = point.ns = (to_previous + to_next).normalized();
      return point;
    };
    const SurfacePoint one = point_between(first, -d0, d1), two = point_between(second, -d1, d2);
    const auto isect = [&](const SurfacePoint& point, const Vec3& wo) {
      return ShadingPoint<Bsdf>(scene.bsdf(scene.surfaces()[0]), point, wo);
    };
    const LightConnection light{Spectrum::Ones(), 1, Float(0.7), 0, {d2, Spectrum::Ones(), 1, lamp}};
    const Float pdf = Float(0.2);

    PartialMisWeight partial_mis = mis.start(d0);
    mis.arrive(partial_mis, 1, eye, d0, one);
    EXPECT_EQ(mis.direct_ratio(partial_mis, 1, isect(one, -d0), light), 0);
    EXPECT_EQ(mis.emission_ratio(partial_mis, 2, 0, &lamp, first, d1), 0);
    const auto next = [](const Vec3& d, Float density) { return ScatterSample{d, Spectrum::Ones(), density, 1, 1}; };
    mis.scatter(partial_mis, 1, isect(one, -d0), next(d1, Float(0.3)));
    mis.arrive(partial_mis, 2, first, d1, two);
    const double ratio_of_nee = mis.direct_ratio(partial_mis, 2, isect(two, -d1), light);
    mis.scatter(partial_mis, 2, isect(two, -d1), next(d2, pdf));
    mis.arrive(partial_mis, 3, second, d2, lamp);
    const double ratio_of_hit = mis.emission_ratio(partial_mis, 3, 0, &lamp, second, d2);
    EXPECT_GT(ratio_of_hit, 0);
    EXPECT_NEAR(ratio_of_nee * mc::sqr(double(light.pdf)) / (ratio_of_hit * mc::sqr(double(pdf))), 1, 1e-4);
  }
}

} // namespace
