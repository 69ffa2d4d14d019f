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

TEST(SceneBuilder, AnEmptySceneIsRefusedUnlessItHasABackground) {
  SceneBuilder builder;
  EXPECT_THROW(builder.build(), mc::Error);
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  EXPECT_NO_THROW(builder.build());
  EXPECT_THROW(builder.build(), mc::Error) << "build() leaves the builder empty";
}

TEST(SceneBuilder, SaysWhatIsWrong) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  const Shape ball = Sphere(Vec3d::Zero(), 1), flat = TriangleMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  builder.add(ball, {gray});
  EXPECT_THAT(message([&] { builder.add(ball, {BsdfId(3)}); }), testing::HasSubstr("shape 1 names BSDF 3 of 1"));
  EXPECT_THAT(message([&] { builder.add(flat, {gray, Emission{}}); }), testing::HasSubstr("needs an area > 0"));
  // What was refused has left nothing behind.
  const Scene scene = builder.build();
  EXPECT_EQ(scene.surfaces().size(), 1u);
  EXPECT_TRUE(scene.lights().empty());
}

} // namespace
