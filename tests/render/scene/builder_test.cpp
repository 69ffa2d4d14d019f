#include <render/scene/builder.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

template <class F> std::string message(F&& f) {
  try {
    f();
    return "no error";
  } catch (const mc::Error& e) {
    return e.what();
  }
}

TexturedBsdf textured(const Spectrum& color0, const Spectrum& color1) {
  return {Lambert(), {.diffuse_reflectance = Checkerboard(color0, color1)}};
}

TEST(SceneBuilder, AnEmptySceneIsRefusedUnlessItHasABackground) {
  SceneBuilder builder;
  EXPECT_THROW(builder.build(), mc::Error);
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  EXPECT_NO_THROW(builder.build());
  EXPECT_THROW(builder.build(), mc::Error) << "build() leaves the builder empty";
}

TEST(SceneBuilder, ErrorsNameTheProblem) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  const Shape ball = Sphere(Vec3d::Zero(), 1), flat = TriangleMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  builder.add(ball, {gray});
  EXPECT_THAT(message([&] { builder.add(ball, {BsdfId(3)}); }), testing::HasSubstr("shape 1 names BSDF 3 of 1"));
  EXPECT_THAT(message([&] { builder.add(flat, {gray, Emission{}}); }), testing::HasSubstr("needs an area > 0"));
  const BsdfId board = builder.add(textured(Spectrum::Zero(), Spectrum::Ones()));
  const Shape untextured = TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_THAT(message([&] { builder.add(untextured, {board}); }),
              testing::HasSubstr("shape 1 has no texture coordinates"));
  EXPECT_THAT(message([&] { builder.add(untextured, {.bsdf = board, .missing_uv_reason = "a.obj: why"}); }),
              testing::EndsWith("which its texture needs: a.obj: why"));
  Material holes(Dielectric(Float(1.5)));
  holes.mask = std::make_shared<const Mask>(Float(0.5));
  const BsdfId lattice = builder.add(holes);
  const HomogeneousMedium ink(Spectrum::Ones());
  EXPECT_THAT(message([&] { builder.add(ball, {.bsdf = lattice, .interior = ink}); }),
              testing::HasSubstr("shape 1 holds a medium"));
  // Rejected parts are not in the scene.
  const Scene scene = builder.build();
  EXPECT_EQ(scene.surfaces().size(), 1u);
  EXPECT_TRUE(scene.lights().empty());
}

// Only meshes that are lights or importance targets keep the table for sampling triangles.
TEST(SceneBuilder, KeepsSamplingTablesOfLightsAndTargets) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(TriangleMesh::rectangle({}), {gray});
  builder.add(TriangleMesh::rectangle({}), {gray, Emission{}});
  builder.add(TriangleMesh::rectangle({}), {.bsdf = gray, .importance_target = true});
  const Scene scene = builder.build();
  const auto sampled = [&](std::size_t i) {
    return scene.surfaces()[i].shape->sample(Vec3(0, 0, 5), Vec2(Float(0.3), Float(0.6))).has_value();
  };
  EXPECT_FALSE(sampled(0));
  EXPECT_TRUE(sampled(1));
  EXPECT_TRUE(sampled(2));
}

TEST(SceneBuilder, ATextureLiesWhereTheCoordinatesSay) {
  SceneBuilder builder;
  const Spectrum dark = Spectrum::Constant(Float(0.25)), light = Spectrum::Constant(Float(0.75));
  builder.add(TriangleMesh::rectangle({}), {builder.add(textured(dark, light))});
  const Scene scene = builder.build();
  for (const double x : {-0.9, -0.3, 0.2, 0.7})
    for (const double y : {-0.8, -0.1, 0.4, 0.6}) {
      const Ray ray{Vec3(Float(x), Float(y), 1), Vec3(0, 0, -1)};
      const auto hit = scene.intersect(ray);
      ASSERT_TRUE(hit);
      std::optional<Bsdf> varied;
      const Bsdf& here = scene.bsdf(scene.surface(*hit), *hit, scene.surface_point(ray, *hit), varied);
      EXPECT_EQ(std::get<Lambert>(here).albedo()[0], ((x < 0) == (y < 0) ? dark : light)[0]) << x << ", " << y;
    }
}

} // namespace
