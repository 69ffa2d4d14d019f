#include <render/integrator/path_steps.h>
#include <render/scene/builder.h>

#include <mc/estimate/moments.h>
#include <mc/sampler/walk_stream.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

using StepStream = mc::IndependentWalk<Float>;
const mc::NoPairs step_numbers(11, 0);

/// A mirror at z = 0 that faces a grey wall at z = 2, which shines a little.
Scene mirror_and_wall() {
  SceneBuilder builder;
  builder.add(TriangleMesh::rectangle(Transform::scale({5, 5, 1})),
              {builder.add(Metal(Spectrum::Constant(Float(0.5))))});
  builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 2}) * Transform::rotate(Vec3d::UnitX(), 180) *
                                      Transform::scale({5, 5, 1})),
              {builder.add(Lambert(Spectrum::Constant(Float(0.2)))), Emission{Spectrum::Constant(3)}});
  return builder.build();
}

/// Sums what is found.
struct Sum {
  Spectrum light = Spectrum::Zero();
  void operator()(const FoundLight& found) { light += found.counted(); }
};

const Ray at_mirror{Vec3(0, 0, 1), Vec3(0, 0, -1)};

TEST(FoundLight, CountsByTheOddsAgainstIt) {
  EXPECT_EQ(FoundLight{Spectrum::Constant(6)}.counted()[1], 6);
  EXPECT_EQ((FoundLight{Spectrum::Constant(6), 2}.counted()[1]), 2);
  EXPECT_EQ((FoundLight{Spectrum::Constant(6), mc::infinity<double>}.counted()[1]), 0);
}

// By way of the mirror to the wall, whose light counts half.
TEST(PathSteps, ArriveAtRoughByWayOfMirrors) {
  const Scene scene = mirror_and_wall();
  const PathSteps<Scene> steps(scene, strategy_from("nee"), -1, nullptr);
  Walk walk = steps.start(at_mirror, {});
  PathSteps<Scene>::Place place;
  StepStream stream(step_numbers, 0);
  std::uint64_t rays = 0;
  Sum sum;
  ASSERT_TRUE(steps.arrive_at_rough(walk, place, stream, rays, [&](const FoundLight& found) { sum(found); }));
  EXPECT_EQ(walk.edges, 2);
  EXPECT_EQ(rays, 2u);
  EXPECT_NEAR(place.point.p.z(), 2, 1e-6);
  EXPECT_TRUE(place.bsdf->is_diffuse());
  EXPECT_NEAR(walk.beta[0], 0.5, 1e-6);
  EXPECT_NEAR(sum.light[0], 1.5, 1e-5);
}

// No edge beyond the longest path, and nothing where the path leaves the scene.
TEST(PathSteps, EndWhereThePathDoes) {
  const Scene scene = mirror_and_wall();
  const auto reaches = [&](int max_depth, const Ray& ray) {
    const PathSteps<Scene> steps(scene, strategy_from("nee"), max_depth, nullptr);
    Walk walk = steps.start(ray, {});
    PathSteps<Scene>::Place place;
    StepStream stream(step_numbers, 0);
    std::uint64_t rays = 0;
    return steps.arrive_at_rough(walk, place, stream, rays, [](const FoundLight&) {});
  };
  EXPECT_TRUE(reaches(3, at_mirror));
  EXPECT_FALSE(reaches(2, at_mirror)); // the wall is met, but the path may not go on
  EXPECT_FALSE(reaches(1, at_mirror));
  EXPECT_FALSE(reaches(-1, {Vec3(0, 0, 1), Vec3(1, 0, 0)}));
}

// What survives weighs for what does not; the first edges always do, and what is invalid is never lost.
TEST(PathSteps, RouletteKeepsTheMean) {
  StepStream stream(step_numbers, 1);
  const auto beta_after = [&](int edges, Float beta, Float worth) {
    Walk walk;
    walk.edges = edges;
    walk.beta = Spectrum::Constant(beta);
    walk.worth = worth;
    return PathSteps<Scene>::survives(walk, stream) ? double(walk.beta[0]) : 0;
  };
  EXPECT_EQ(beta_after(3, Float(1e-6), 1), double(Float(1e-6)));
  EXPECT_EQ(beta_after(9, mc::infinity<Float>, 1), mc::infinity<double>);
  for (const Float worth : {Float(1), Float(0.25)}) {
    mc::Moments moments, survivors;
    for (int i = 0; i < 20'000; ++i) {
      const double beta = beta_after(5, Float(0.1), worth);
      moments.add(beta);
      survivors.add(beta > 0);
    }
    EXPECT_NEAR(moments.mean(), 0.1, 4.5 * moments.std_error());
    EXPECT_NEAR(survivors.mean(), 4 * 0.1 * double(worth), 4.5 * survivors.std_error());
  }
}

TEST(PathSteps, WithoutPathsFromTheLightsHaveNoOdds) {
  const Scene scene = mirror_and_wall();
  const PathSteps<Scene> steps(scene, strategy_from("mis"), -1, nullptr);
  Walk walk = steps.start(at_mirror, {});
  PathSteps<Scene>::Place place;
  StepStream stream(step_numbers, 2);
  std::uint64_t rays = 0;
  ASSERT_TRUE(steps.arrive_at_rough(walk, place, stream, rays, [](const FoundLight&) {}));
  EXPECT_EQ(steps.odds_at(place.point, place.at(walk), walk, Vec3(0, 0, -1), 1), 0);
}

} // namespace
