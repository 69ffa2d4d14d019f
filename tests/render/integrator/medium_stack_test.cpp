#include <render/integrator/medium_stack.h>
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

TEST(SurfaceInteraction, MediumFollowsSideOfDirection) {
  const Onion onion({1});
  const Surface& surface = onion.scene.surfaces()[0];
  SurfacePoint point;
  point.p = point.ng = point.ns = Vec3::UnitZ();
  const Dielectric glass;
  const HomogeneousMedium outer(Spectrum::Ones());
  const Vec3 in(0, 0, -1), out(0, 0, 1);
  const auto from = [&](const Vec3& wo, const MediumStack& before) {
    return SurfaceInteraction<Dielectric>{{glass, point, mc::Frame<Float>::from_z(point.ns), wo}, surface, before};
  };
  const auto entering = from(out, {&outer, nullptr});
  EXPECT_EQ(onion.ball(entering.media(in).current), 0);
  EXPECT_EQ(entering.media(in).outer, &outer);
  EXPECT_EQ(entering.media(out).current, &outer);
  const auto leaving = from(in, {&*surface.interior, &outer});
  EXPECT_EQ(leaving.media(out).current, &outer);
  EXPECT_EQ(leaving.media(out).outer, nullptr);
  EXPECT_EQ(onion.ball(leaving.media(in).current), 0);
}

} // namespace
