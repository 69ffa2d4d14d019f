#include <render/integrator/direct_lighting.h>
#include <render/scene/builder.h>

#include <mc/sampler/path_sample_stream.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

/// Connections from the origin of a floor z = 0 of reflectance 1/2, seen from above, to a light. Between them may be a
/// roof.
struct Floor {
  explicit Floor(const Light& light, bool roof = false) {
    builder.add(light);
    builder.add(Sphere(Vec3d(0, 0, -100), 1), {builder.add(Lambert())});
    if (roof)
      builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 1}) * Transform::scale({5, 5, 1})),
                  {builder.add(Lambert())});
  }

  std::optional<LightConnection> connect() {
    const Scene scene = builder.build();
    const Bsdf bsdf = Lambert(Spectrum::Constant(Float(0.5)));
    SurfacePoint point;
    point.p = Vec3::Zero();
    point.ng = point.ns = Vec3::UnitZ();
    const Interaction<Bsdf> isect{{bsdf, point, point.ng}, nullptr, {}};
    const mc::IndependentPairs numbers(1, 0);
    mc::IndependentPathStream<Float> stream(numbers, 0);
    const Strategy& mis = strategy_from("mis");
    return connect_to_light(scene, mis.direct_lighting, DirectionMixture(scene, mis), isect, stream, rays);
  }

  SceneBuilder builder;
  std::uint64_t rays = 0;
};

// Radiance rho / pi I cos / d^2.
TEST(ConnectToLight, PointLight_MatchesClosedForm) {
  Floor floor(PointLight({3, 0, 4}, Spectrum(1, 2, 3)));
  const auto light = floor.connect();
  ASSERT_TRUE(light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light->value[c], 0.5 / mc::pi<double> * (c + 1) * 0.8 / 25, 1e-7);
  EXPECT_EQ(light->mis_weight, 1);
  EXPECT_EQ(light->index, 0u);
  EXPECT_EQ(floor.rays, 1u);
}

TEST(ConnectToLight, HiddenLight_GivesNothing) {
  Floor below(PointLight({0, 0, -4}, Spectrum::Ones())), hidden(PointLight({0, 0, 4}, Spectrum::Ones()), true);
  EXPECT_FALSE(below.connect());
  EXPECT_EQ(below.rays, 0u);
  EXPECT_FALSE(hidden.connect());
  EXPECT_EQ(hidden.rays, 1u);
}

} // namespace
