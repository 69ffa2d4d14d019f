#include <render/integrator/light_tracer.h>
#include <render/pixel_renderer.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/path_sample_stream.h>

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace render;

const Strategy& mis_lt = strategy_from("mis+lt");

/// A camera looks down at a floor under a lamp. A wall, and a ball that makes light paths pay, are outside its view.
struct Room {
  bool two_sided = false, glass = true, lamp = true, sky = false;
  std::optional<Light> delta = {};
  Bsdf ball = Dielectric();
  Bsdf floor = Lambert();
  Filter filter = BoxFilter();

  Scene build() const {
    SceneBuilder builder;
    builder.add(TriangleMesh::rectangle(Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale(Vec3d::Constant(3))),
                {builder.add(floor)});
    builder.add(TriangleMesh::rectangle(Transform::translate({2.2, 1, 0}) * Transform::rotate(Vec3d::UnitY(), -90) *
                                        Transform::scale(Vec3d::Constant(2))),
                {builder.add(Lambert(Spectrum::Ones()))});
    const BsdfId black = builder.add(Lambert(Spectrum::Zero()));
    const auto emission = lamp ? std::optional(Emission{Spectrum::Constant(2), two_sided}) : std::nullopt;
    builder.add(TriangleMesh::rectangle(Transform::translate({1, 2, 0}) * Transform::rotate(Vec3d::UnitX(), 90) *
                                        Transform::scale(Vec3d::Constant(0.5))),
                {black, emission});
    builder.add(Sphere(Vec3d(-1.5, 1.2, 1.5), 0.5), {glass ? builder.add(ball) : black});
    builder.set(filter);
    if (delta) builder.add(*delta);
    builder.set(ThinLens(Transform::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 1}), {.fov = 40}));
    if (sky)
      builder.add(
          Light(Environment(std::make_shared<const Texels>(2, 1, std::vector<Spectrum>{{1, 1, 1}, {3, 1, 2}}))));
    else builder.add(Light(ConstantBackground(Spectrum::Zero())));
    return builder.build();
  }
};

TEST(LightTracer, IsCreatedOnlyForCausticScenes) {
  EXPECT_TRUE(LightTracer::create(Room().build(), mis_lt, 1));
  EXPECT_FALSE(LightTracer::create(Room().build(), strategy_from("mis"), 1));
  EXPECT_FALSE(LightTracer::create(Room{.glass = false}.build(), mis_lt, 1));
  EXPECT_FALSE(LightTracer::create(Room{.lamp = false}.build(), mis_lt, 1));
  EXPECT_TRUE(LightTracer::create(Room{.lamp = false, .sky = true}.build(), mis_lt, 1));
  EXPECT_FALSE(LightTracer::create(Room{.glass = false, .lamp = false, .sky = true}.build(), mis_lt, 1));
  EXPECT_FALSE(LightTracer::create(Room{.filter = BoxFilter(70)}.build(), mis_lt, 1));
  EXPECT_EQ(complete_strategies(Room().build()).size(), strategies.size());
  EXPECT_EQ(complete_strategies(Room{.glass = false}.build()).size(), strategies.size() - 1);
}

/// Parallel light from above onto a row of glass cubes. Their corners lie on spheres of radius sqrt(3) / 10, from the
/// eighth cube on sqrt(3) / 20.
Scene row_of_cubes(int count) {
  SceneBuilder builder;
  const BsdfId glass = builder.add(Dielectric());
  for (int i = 0; i < count; ++i)
    builder.add(TriangleMesh::box(Transform::translate({double(i), 0, 0}) *
                                  Transform::scale(Vec3d::Constant(i < 7 ? 0.1 : 0.05))),
                {glass});
  builder.add(Light(DirectionalLight(-Vec3d::UnitY(), Spectrum::Ones())));
  builder.set(ThinLens(Transform::look_at({0, 0, 9}, {0, 0, 0}, {0, 1, 0}), {.fov = 40}));
  return builder.build();
}

// Up to eight cubes have a ball each. With more cubes the seven largest have a ball each, and one ball encloses the
// others; its disk is a circle about their row.
TEST(LightTracer, EmissionIsAimedAtCausticBounds) {
  for (const int count : {1, 8, 12}) {
    const Scene scene = row_of_cubes(count);
    const auto paths = LightTracer::create(scene, mis_lt, 1);
    ASSERT_TRUE(paths) << count;
    const auto density = [&](double x) {
      return std::sqrt(paths->emission_pdf_squared(0, nullptr, Vec3(Float(x), -5, 0), Vec3::UnitY())) * mc::pi<double> *
             std::min(count, 8);
    };
    const double small2 = 0.0075, row2 = (mc::sqr(4 + 2 * std::sqrt(small2)) + 8 * small2) / 4;
    EXPECT_NEAR(density(0) * 0.03, paths->light_path_rate(), 1e-5) << count;
    const double last2 = std::map<int, double>{{1, 0.03}, {8, small2}, {12, row2}}[count];
    EXPECT_NEAR(density(count - 0.95) * last2, paths->light_path_rate(), 1e-5) << count;
    EXPECT_EQ(density(0.5), 0);
    EXPECT_EQ(density(9.5) > 0, count == 12);
    EXPECT_EQ(density(count - 0.6), 0);
  }
}

// Light paths do not aim at glass that the lamp overlaps: all follow the cosine. Otherwise a fifth follows it.
TEST(LightTracer, EnclosedLight_IsNotGuidedToItsEnclosure) {
  for (const bool inside : {false, true}) {
    SceneBuilder builder;
    const Vec3d at(0, inside ? 1 : 3, 0);
    builder.add(TriangleMesh::rectangle(Transform::translate(at) * Transform::rotate(Vec3d::UnitX(), 90) *
                                        Transform::scale(Vec3d::Constant(0.1))),
                {builder.add(Lambert()), Emission{Spectrum::Ones()}});
    builder.add(TriangleMesh::box(Transform::scale(Vec3d::Constant(1))), {builder.add(Dielectric())});
    builder.set(ThinLens(Transform::look_at({0, 0, 9}, {0, 0, 0}, {0, 1, 0}), {.fov = 40}));
    const Scene scene = builder.build();
    const auto paths = LightTracer::create(scene, mis_lt, 1);
    ASSERT_TRUE(paths);
    SurfacePoint met;
    met.p = at.cast<Float>();
    met.ng = met.ns = -Vec3::UnitY();
    const Vec3 aside = Vec3(Float(0.99), Float(-std::sqrt(1 - 0.99 * 0.99)), 0).normalized();
    const double by_cosine = paths->light_path_rate() / 0.04 * double(-aside.y()) / mc::pi<double>;
    EXPECT_NEAR(std::sqrt(paths->emission_pdf_squared(0, &met, {}, -aside)) / by_cosine, inside ? 1 : 0.2, 1e-5);
  }
}

TEST(LightTracer, IsCreatedForGlossyMetalOnly) {
  const Spectrum white = Spectrum::Ones();
  for (const Float fuzz : {Float(0), Float(0.5), Float(0.6)})
    EXPECT_EQ(LightTracer::create(Room{.ball = FuzzyMetal(white, fuzz)}.build(), mis_lt, 1).has_value(), fuzz <= 0.5);
  for (const Float alpha : {Float(1e-4), Float(0.2), Float(0.3)}) {
    const Bsdf ball = RoughConductor<TrowbridgeReitzFacets>(white * 0, white, TrowbridgeReitzFacets(alpha));
    EXPECT_EQ(LightTracer::create(Room{.ball = ball}.build(), mis_lt, 1).has_value(), alpha <= Float(0.2));
  }
}

// The density of emission integrates to light_path_rate() over the lamp and all directions. The integral is estimated
// from 1e5 uniform points and directions, with a bound of four standard errors. On the side of the lamp away from the
// ball, the four fifths of the paths that aim at the ball are lost.
TEST(LightTracer, AreaEmissionPdf_IntegratesToRate) {
  for (const bool two_sided : {false, true}) {
    const Scene scene = Room{.two_sided = two_sided}.build();
    const auto paths = LightTracer::create(scene, mis_lt, 1);
    ASSERT_TRUE(paths);
    const Shape& lamp = std::get<AreaLight>(scene.lights()[0]).shape();
    mc::Pcg random(3);
    mc::Moments moments;
    for (int i = 0; i < 100'000; ++i) {
      const auto point = lamp.sample_area(random.point<Float, 2>());
      const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
      moments.add(std::sqrt(paths->emission_pdf_squared(0, &*point, {}, -d)) * lamp.area() * 4 * mc::pi<double>);
    }
    const double expected = paths->light_path_rate() * (two_sided ? 0.6 : 1);
    EXPECT_NEAR(moments.mean(), expected, 4 * moments.std_error());
  }
}

// The same for a point light over all directions, and for parallel light over lines within a disk that covers the ball.
TEST(LightTracer, DeltaEmissionPdf_IntegratesToRate) {
  const Vec3 ball(-1.5, Float(1.2), 1.5), at(1, 2, 0), wi = Vec3(1, 2, 3).normalized();
  const Scene point = Room{.lamp = false, .delta = PointLight(at.cast<double>(), Spectrum::Ones())}.build(),
              sun = Room{.lamp = false, .delta = DirectionalLight(-wi.cast<double>(), Spectrum::Ones())}.build();
  const auto from_point = LightTracer::create(point, mis_lt, 1), from_sun = LightTracer::create(sun, mis_lt, 1);
  ASSERT_TRUE(from_point && from_sun);
  const auto frame = mc::Frame<Float>::from_z(wi);
  mc::Pcg random(7);
  mc::Moments of_point, of_sun;
  for (int i = 0; i < 1'000'000; ++i) {
    const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    of_point.add(std::sqrt(from_point->emission_pdf_squared(0, nullptr, at - 3 * d, d)) * 9 * 4 * mc::pi<double>);
    const Vec2 disk = mc::UniformDisk<Float>{}.sample(random.point<Float, 2>());
    const Vec3 p = ball + frame.to_world({disk[0], disk[1], -3});
    of_sun.add(std::sqrt(from_sun->emission_pdf_squared(0, nullptr, p, wi)) * mc::pi<double>);
  }
  EXPECT_NEAR(of_point.mean(), from_point->light_path_rate(), 4 * of_point.std_error());
  EXPECT_NEAR(of_sun.mean(), from_sun->light_path_rate(), 4 * of_sun.std_error());
  EXPECT_LE(of_point.std_error() + of_sun.std_error(), 0.02 * from_point->light_path_rate());
}

// The same for a sky, over all directions and lines within a disk that covers the ball.
TEST(LightTracer, EnvironmentEmissionPdf_IntegratesToRate) {
  const Scene scene = Room{.lamp = false, .sky = true}.build();
  const auto paths = LightTracer::create(scene, mis_lt, 1);
  ASSERT_TRUE(paths);
  mc::Pcg random(5);
  mc::Moments moments;
  for (int i = 0; i < 100'000; ++i) {
    const Vec3 d = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    const Vec2 disk = mc::UniformDisk<Float>{}.sample(random.point<Float, 2>());
    const Vec3 p = Vec3(-1.5, Float(1.2), 1.5) + mc::Frame<Float>::from_z(d).to_world({disk[0], disk[1], 7});
    moments.add(std::sqrt(paths->emission_pdf_squared(scene.infinite_lights()[0], nullptr, p, d)) * 4 *
                mc::sqr(mc::pi<double>));
  }
  EXPECT_NEAR(moments.mean(), paths->light_path_rate(), 4 * moments.std_error());
  EXPECT_LE(moments.std_error(), 0.01 * paths->light_path_rate());
}

// Light paths and camera paths of up to three edges add up to `mis` alone, over a film of one pixel. A hundred light
// paths for each camera path give both a visible share.
void expect_both_to_make_what_one_does(const Scene& scene) {
  Strategy many = mis_lt;
  many.light_path_rate = 100;
  const auto paths = LightTracer::create(scene, many, 1);
  ASSERT_TRUE(paths);
  const PathIntegrator<Scene, LightPathMis> both(scene, {many, 3}, LightPathMis(*paths));
  const PathIntegrator<Scene> alone(scene, {strategy_from("mis"), 3});
  const mc::IndependentPairs numbers(17, 0);
  mc::Moments given, left, all;
  std::uint64_t rays = 0;
  const Vec2 tangent = scene.camera().tan_half(1);
  for (std::uint32_t i = 0; i < 400'000; ++i) {
    mc::IndependentPathStream<Float> stream(numbers, i);
    const Ray ray = scene.camera().ray(stream.next2(), tangent, {0, 0});
    left.add(double(both.Li(ray, stream, rays)[0]));
    all.add(double(alone.Li(ray, stream, rays)[0]));
    double value = 0;
    paths->trace(stream, 3, rays, [&](const Vec2& s, const Spectrum& v) {
      if (s.minCoeff() >= 0 && s.maxCoeff() < 1) value += double(v[0]) * paths->light_path_rate();
    });
    given.add(value);
  }
  EXPECT_GT(given.mean(), 0.01 * all.mean());
  EXPECT_GT(left.mean(), 0.01 * all.mean());
  const double error = std::sqrt(mc::sqr(given.std_error()) + mc::sqr(left.std_error()) + mc::sqr(all.std_error()));
  EXPECT_LE(error, 0.01 * all.mean());
  EXPECT_NEAR(given.mean() + left.mean(), all.mean(), 4 * error);
}
TEST(LightTracer, PlusCameraPaths_MatchesMis) {
  expect_both_to_make_what_one_does(Room().build());
  expect_both_to_make_what_one_does(Room{.lamp = false, .delta = PointLight({1, 2, 0}, Spectrum::Ones())}.build());
}

// Light from a lamp by way of one surface is left to next-event estimation. Light paths would add the noise of their
// random number in each pixel.
TEST(LightTracer, SkipsPathsOfTwoEdges) {
  const Scene scene = Room().build();
  const auto paths = LightTracer::create(scene, mis_lt, 1);
  ASSERT_TRUE(paths);
  const mc::IndependentPairs numbers(17, 0);
  std::uint64_t rays = 0;
  int direct = 0, longer = 0;
  for (std::uint32_t i = 0; i < 10'000; ++i) {
    for (const int depth : {2, 3}) {
      mc::IndependentPathStream<Float> stream(numbers, i);
      paths->trace(stream, depth, rays, [&](const Vec2&, const Spectrum&) { ++(depth == 2 ? direct : longer); });
    }
  }
  EXPECT_EQ(direct, 0);
  EXPECT_GT(longer, 300);
}

/// Light path contributions to an image of one pixel: parallel light falls through a glass ball onto a floor, beside a
/// black plane below of half width `beside`.
mc::Moments cast_by_glass(double beside) {
  SceneBuilder builder;
  const auto plane = [](double y, double size) {
    return TriangleMesh::rectangle(Transform::translate({0, y, 0}) * Transform::rotate(Vec3d::UnitX(), -90) *
                                   Transform::scale(Vec3d::Constant(size)));
  };
  builder.add(plane(0, 3), {builder.add(Lambert())});
  builder.add(plane(-1, beside), {builder.add(Lambert(Spectrum::Zero()))});
  builder.add(Sphere(Vec3d(0, 0.6, 0), 0.5), {builder.add(Dielectric())});
  builder.add(Light(DirectionalLight({1, -1, 0}, Spectrum::Ones())));
  builder.set(ThinLens(Transform::look_at({0, 4, 0}, {0, 0, 0}, {0, 0, 1}), {.fov = 40}));
  const Scene scene = builder.build();
  const auto paths = LightTracer::create(scene, mis_lt, 1);
  mc::Moments moments;
  std::uint64_t rays = 0;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    mc::IndependentPathStream<Float> stream(mc::IndependentPairs(19, 0), i);
    double value = 0;
    paths->trace(stream, -1, rays, [&](const Vec2&, const Spectrum& v) { value += double(v[0]); });
    moments.add(value);
  }
  return moments;
}

// Light paths must not start far away beside a huge ground: floats there resolve the ball poorly.
TEST(LightTracer, DirectionalCaustics_SurviveHugeGround) {
  const mc::Moments small = cast_by_glass(3), huge = cast_by_glass(1e8);
  EXPECT_LE(small.std_error(), 0.02 * small.mean());
  EXPECT_NEAR(huge.mean(), small.mean(), 1e-3 * small.mean()); // both use the same random numbers
}

} // namespace
