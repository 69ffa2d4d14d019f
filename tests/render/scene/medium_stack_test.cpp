#include <render/scene/medium_stack.h>

#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

/// Concentric balls with a medium each; between them are masks, and a wall without a medium.
struct Onion {
  std::vector<HomogeneousMedium> media;
  Scene scene;

  explicit Onion(const std::vector<double>& radii) : scene(build(radii)) {}
  // Index of the ball with this medium; -1 for none.
  int ball(const HomogeneousMedium* m) const {
    for (std::size_t i = 0; i < scene.surfaces().size(); ++i)
      if (m && scene.surfaces()[i].interior && m == &*scene.surfaces()[i].interior) return static_cast<int>(i);
    return -1;
  }
  static Scene build(const std::vector<double>& radii) {
    SceneBuilder builder;
    const BsdfId glass = builder.add(Dielectric());
    for (const double r : radii)
      builder.add(Sphere(Vec3d::Zero(), r),
                  {.bsdf = glass, .interior = HomogeneousMedium(Spectrum::Constant(Float(r)))});
    builder.add(Sphere(Vec3d(0, 0, 2.5), 0.1), {glass});
    return builder.build();
  }
};

TEST(InitialMedia, FindsCurrentAndOuterMedium) {
  const Onion onion({1, 2, 3});
  const auto at = [&](double z, double towards) {
    return initial_media(onion.scene, {Vec3(0, 0, Float(z)), Vec3(0, 0, Float(towards))});
  };
  struct Row {
    double z;
    int here, around;
  };
  for (const auto& [z, here, around] : {Row{0.5, 0, 1}, Row{1.5, 1, 2}, Row{2.2, 2, -1}, Row{4, -1, -1}})
    for (const double towards : {1.0, -1.0}) { // toward the balls, and away from them
      const MediumStack media = at(z, towards);
      EXPECT_EQ(onion.ball(media.current), here) << z << " " << towards;
      EXPECT_EQ(onion.ball(media.outer), around) << z << " " << towards;
    }
}

// A fog surrounds two balls, of which the outer one is within it.
TEST(InitialMedia, AmbientMediumIsOutsideOfAllSurfaces) {
  SceneBuilder builder;
  builder.set_ambient(HomogeneousMedium(Spectrum::Constant(Float(0.1))));
  const BsdfId glass = builder.add(Dielectric());
  for (const double r : {1.0, 2.0})
    builder.add(Sphere(Vec3d::Zero(), r), {.bsdf = glass, .interior = HomogeneousMedium(Spectrum::Constant(Float(r)))});
  const Scene scene = builder.build();
  const HomogeneousMedium *fog = scene.ambient_medium(), *core = scene.surfaces()[0].interior.get(),
                          *shell = scene.surfaces()[1].interior.get();
  ASSERT_NE(fog, nullptr);
  const auto at = [&](Float z) { return initial_media(scene, {Vec3(0, 0, z), Vec3::UnitX()}); };
  EXPECT_EQ(at(5).current, fog);
  EXPECT_EQ(at(Float(1.5)).current, shell);
  EXPECT_EQ(at(Float(1.5)).outer, fog);
  EXPECT_EQ(at(0).current, core);
  EXPECT_EQ(at(0).outer, shell);
}

TEST(MediumStack, BeyondEntersAndLeaves) {
  const HomogeneousMedium fog(Spectrum::Ones()), ink(Spectrum::Ones()), inner(Spectrum::Ones());
  const MediumStack outside{&fog, &fog, &fog};
  EXPECT_EQ(outside.beyond(nullptr, true).current, &fog);
  const MediumStack inside = outside.beyond(&ink, true);
  EXPECT_EQ(inside.current, &ink);
  EXPECT_EQ(inside.outer, &fog);
  const MediumStack deep = inside.beyond(&inner, true);
  EXPECT_EQ(deep.current, &inner);
  EXPECT_EQ(deep.outer, &ink);
  const MediumStack back = deep.beyond(&inner, false);
  EXPECT_EQ(back.current, &ink);
  EXPECT_EQ(back.outer, &fog);
  EXPECT_EQ(back.beyond(&ink, false).current, &fog);
}

} // namespace
