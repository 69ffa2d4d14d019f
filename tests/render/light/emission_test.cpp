#include <render/light/light.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

const Sphere near_ball(Vec3d(0.5, -1.5, 1), 0.6), far_ball(Vec3d(-3, -4, 2), 1);

/// All kinds of lights. Most of them emit toward the balls.
std::vector<Light> all_lights() {
  const auto lamp = std::make_shared<const Shape>(TriangleMesh::rectangle(
      Transform::translate({0.3, 1, 0}) * Transform::rotate(Vec3d::UnitX(), 90) * Transform::scale({0.5, 0.25, 1})));
  const Spectrum color(1, 2, 3);
  const std::vector<Spectrum> texels(8, color);
  return {AreaLight(lamp, {color, false}),
          AreaLight(lamp, {color, true}),
          AreaLight(std::make_shared<const Shape>(Sphere(Vec3d(0, 1, 0), 0.3)), {color, false}),
          ConstantBackground(color),
          GradientBackground(),
          Environment(std::make_shared<const Texels>(4, 2, texels)),
          PointLight(Vec3d(0.2, 1, 0.1), color),
          DirectionalLight(Vec3d(1, -2, 1), color),
          SpotLight(Vec3d(0.2, 1, 0.1), Vec3d(0, -2, 1), color, {60, 20}),
          SpotLight(Vec3d(0.2, 1, 0.1), Vec3d(0, -2, 1), color, {140, 140})};
}

// The weight of a first ray averages to the power into the ball. The bound of four standard errors fails for one of
// the 20 averages in 800 runs with other seeds.
TEST(Emission, WeightsAverageToPower) {
  for (const bool guides : {false, true}) {
    const EmissionTargets targets({near_ball}, guides ? std::vector{near_ball} : std::vector<Sphere>(),
                                  Bounds::around(near_ball.box()));
    mc::Pcg random(5);
    for (const Light& light : all_lights()) {
      // Every ray from an area light or a point also counts if it leaves in the other directions.
      mc::Moments weights;
      for (int i = 0; i < 100'000; ++i) {
        const auto s = light.sample_emission(targets, random.point<Float, 2>(), random.point<Float, 2>());
        weights.add(s ? double(luminance(s->radiance)) * s->cosine / (s->vertex_pdf * s->ray_pdf) : 0);
      }
      const double power = light.power(near_ball.radius());
      EXPECT_NEAR(weights.mean(), power, 4 * weights.std_error() + 1e-4 * power) << light.index();
      EXPECT_LE(weights.std_error(), 0.02 * power) << light.index();
    }
  }
}

// emission_pdf() at any point of a sampled ray equals the densities of the sample.
TEST(Emission, PdfAgreesWithSamples) {
  Bounds scene = Bounds::around(near_ball.box());
  scene.add(Bounds::around(far_ball.box()));
  const EmissionTargets targets({near_ball, far_ball}, {near_ball, far_ball}, scene);
  mc::Pcg random(6);
  for (const Light& light : all_lights()) {
    int agreed = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto s = light.sample_emission(targets, random.point<Float, 2>(), random.point<Float, 2>());
      if (!s) continue;
      const double t = 0.5 + random.uniform<double>();
      const Vec3 ref = s->ray.o + Float(t) * s->ray.d;
      const double pdf = light.emission_pdf(targets, ref, -s->ray.d, s->point ? &*s->point : nullptr);
      const bool from_point = light.is_delta() && s->point;
      const double expected = s->vertex_pdf * s->ray_pdf / (from_point ? t * t : 1);
      EXPECT_GT(expected, 0);
      agreed += std::abs(pdf / expected - 1) <= 1e-3;
    }
    // Next to the outline of a ball, rounding decides whether a ray counts as aimed at it.
    EXPECT_GE(agreed, 200) << light.index();
    int sampled = 0;
    for (int i = 0; i < 1000; ++i)
      sampled += light.sample_emission(targets, random.point<Float, 2>(), random.point<Float, 2>()).has_value();
    EXPECT_LE(std::abs(sampled - agreed), 100) << light.index();
  }
}

// A share guiding_fraction of the directions is aimed at the ball, and the density counts the other part there, too.
TEST(EmissionTargets, AimAtBallsFromOutside) {
  const EmissionTargets aimed({near_ball}, {near_ball}, Bounds::around(near_ball.box())),
      unaimed({near_ball}, {}, Bounds::around(near_ball.box()));
  const CosineEmission down{-Vec3::UnitY()};
  const Vec3 p(Float(0.3), 1, 0), d = (near_ball.center().cast<Float>() - p).normalized();
  const double cosine = double(-d.y()) / mc::pi<double>;
  EXPECT_NEAR(double(unaimed.direction_pdf(p, d, down)), cosine, 1e-6);
  EXPECT_NEAR(double(aimed.direction_pdf(p, d, down)), 0.2 * cosine + 0.8 * double(near_ball.pdf(p, d)), 1e-5);
  EXPECT_NEAR(double(aimed.direction_pdf(p, -Vec3::UnitY(), down)), 0.2 / mc::pi<double>, 1e-6);
  mc::Pcg random(7);
  int hits = 0;
  for (int i = 0; i < 10'000; ++i)
    hits += near_ball.pdf(p, aimed.sample_direction(p, random.point<Float, 2>(), down)->wi) > 0;
  EXPECT_GE(hits, 8000);
}

// Rays of parallel light start outside the scene and cross the disk of a ball.
TEST(EmissionTargets, ParallelRaysCrossTheBalls) {
  Bounds scene = Bounds::around(near_ball.box());
  scene.add(Bounds::around(far_ball.box()));
  const EmissionTargets targets({near_ball, far_ball}, {}, scene);
  const Vec3 wi = Vec3(1, 2, -1).normalized();
  mc::Pcg random(8);
  std::array<int, 2> hits = {};
  for (int i = 0; i < 1000; ++i) {
    const auto s = targets.sample_parallel(wi, Spectrum::Ones(), 1, random.point<Float, 2>());
    if (!s) continue;
    EXPECT_FALSE(s->point);
    EXPECT_EQ(s->ray_pdf, targets.parallel_pdf(s->ray.o, wi));
    hits[0] += near_ball.intersect(s->ray).has_value();
    hits[1] += far_ball.intersect(s->ray).has_value();
  }
  for (const int n : hits) EXPECT_NEAR(n, 500, 80); // five standard deviations
  const EmissionTargets none({}, {}, Bounds());
  EXPECT_FALSE(none.sample_parallel(wi, Spectrum::Ones(), 1, {}));
  EXPECT_EQ(none.parallel_pdf(Vec3::Zero(), wi), 0);
}

} // namespace
