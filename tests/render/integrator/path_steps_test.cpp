#include <render/integrator/path_steps.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/path_sample_stream.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

using StepStream = mc::IndependentPathStream<Float>;
const mc::IndependentPairs step_numbers(11, 0);

/// A mirror at z = 0 that faces a grey wall at z = 2. The wall emits a little light.
Scene mirror_and_wall() {
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle(Transform::scale({5, 5, 1})),
              {builder.add(FuzzyMetal(Spectrum::Constant(Float(0.5))))});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 2}) * Transform::rotate(Vec3d::UnitX(), 180) *
                                      Transform::scale({5, 5, 1})),
              {builder.add(Lambert(Spectrum::Constant(Float(0.2)))), Emission{Spectrum::Constant(3)}});
  return builder.build();
}

/// Sum of the contributions.
struct Sum {
  Spectrum light = Spectrum::Zero();
  void operator()(const RadianceContribution& contribution) { light += contribution.weighted(); }
};

const Ray at_mirror{Vec3(0, 0, 1), Vec3(0, 0, -1)};

TEST(RadianceContribution, WeightedByMisRatio) {
  EXPECT_EQ(RadianceContribution{Spectrum::Constant(6)}.weighted()[1], 6);
  EXPECT_EQ((RadianceContribution{Spectrum::Constant(6), 2}.weighted()[1]), 2);
  EXPECT_EQ((RadianceContribution{Spectrum::Constant(6), mc::infinity<double>}.weighted()[1]), 0);
}

// The path reaches the wall by way of the mirror of reflectance 1/2, which halves the wall's light.
TEST(PathSteps, SkipDeltaBouncesThroughMirrors) {
  const Scene scene = mirror_and_wall();
  const PathSteps<Scene> steps(scene, strategy_from("nee"), -1, nullptr);
  PathState state = steps.start_path(at_mirror, {});
  PathSteps<Scene>::PathVertex vertex;
  StepStream stream(step_numbers, 0);
  std::uint64_t rays = 0;
  Sum sum;
  ASSERT_TRUE(steps.skip_delta_bounces(state, vertex, stream, rays,
                                       [&](const RadianceContribution& contribution) { sum(contribution); }));
  EXPECT_EQ(state.edges, 2);
  EXPECT_EQ(rays, 2u);
  EXPECT_NEAR(vertex.point.p.z(), 2, 1e-6);
  EXPECT_TRUE(vertex.bsdf->is_diffuse());
  EXPECT_NEAR(state.beta[0], 0.5, 1e-6);
  EXPECT_NEAR(sum.light[0], 1.5, 1e-5);
}

// A path has no edge beyond its largest depth, and none after it leaves the scene.
TEST(PathSteps, SkipDeltaBounces_StopsAtPathEnd) {
  const Scene scene = mirror_and_wall();
  const auto reaches = [&](int max_depth, const Ray& ray) {
    const PathSteps<Scene> steps(scene, strategy_from("nee"), max_depth, nullptr);
    PathState state = steps.start_path(ray, {});
    PathSteps<Scene>::PathVertex vertex;
    StepStream stream(step_numbers, 0);
    std::uint64_t rays = 0;
    return steps.skip_delta_bounces(state, vertex, stream, rays, [](const RadianceContribution&) {});
  };
  EXPECT_TRUE(reaches(3, at_mirror));
  EXPECT_FALSE(reaches(2, at_mirror)); // the second edge hits the wall, but the path must end there
  EXPECT_FALSE(reaches(1, at_mirror));
  EXPECT_FALSE(reaches(-1, {Vec3(0, 0, 1), Vec3(1, 0, 0)}));
}

// The survivors' weight keeps the mean. The first edges always survive, and so do invalid paths.
TEST(PathSteps, RouletteKeepsTheMean) {
  StepStream stream(step_numbers, 1);
  const auto beta_after = [&](int edges, Float beta, Float eta_scale) {
    PathState state;
    state.edges = edges;
    state.beta = Spectrum::Constant(beta);
    state.eta_scale = eta_scale;
    return PathSteps<Scene>::russian_roulette(state, stream) ? double(state.beta[0]) : 0;
  };
  EXPECT_EQ(beta_after(3, Float(1e-6), 1), double(Float(1e-6)));
  EXPECT_EQ(beta_after(9, mc::infinity<Float>, 1), mc::infinity<double>);
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

TEST(PathSteps, WithoutLightTracer_MisRatioIsZero) {
  const Scene scene = mirror_and_wall();
  const PathSteps<Scene> steps(scene, strategy_from("mis"), -1, nullptr);
  PathState state = steps.start_path(at_mirror, {});
  PathSteps<Scene>::PathVertex vertex;
  StepStream stream(step_numbers, 2);
  std::uint64_t rays = 0;
  ASSERT_TRUE(steps.skip_delta_bounces(state, vertex, stream, rays, [](const RadianceContribution&) {}));
  EXPECT_EQ(steps.mis_ratio_at(vertex.point, vertex.interaction(state), state, Vec3(0, 0, -1), 1), 0);
}

} // namespace
