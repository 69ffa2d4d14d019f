#include <render/scene/scene.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

Scene one_sphere(Spectrum radiance = Spectrum::Ones()) {
  Scene scene;
  scene.bsdfs.push_back(Lambert{});
  scene.add(Sphere(Vec3d::Zero(), 1), 0, AreaLight{-1, radiance});
  return scene;
}

TEST(Scene, EmptySceneIsRefusedUnlessItHasABackground) {
  Scene scene;
  EXPECT_THROW(scene.prepare(), mc::Error);
  scene.background = ConstantBackground{Spectrum::Ones()};
  EXPECT_NO_THROW(scene.prepare());
  EXPECT_TRUE(scene.has_light());
}

TEST(Scene, AddLinksShapeBsdfAndLight) {
  Scene scene = one_sphere();
  EXPECT_EQ(scene.add(Sphere(Vec3d(5, 0, 0), 1), 0), 1);
  scene.prepare();
  EXPECT_EQ(scene.lights[0].shape, 0);
  EXPECT_EQ(scene.shape_light[1], -1);
  EXPECT_TRUE(scene.has_light());
}

TEST(Scene, SaysWhatIsWrong) {
  const auto message = [](Scene scene) {
    try {
      scene.prepare();
      return std::string("no error");
    } catch (const mc::Error& e) {
      return std::string(e.what());
    }
  };
  Scene scene = one_sphere();
  scene.add(Sphere(Vec3d::Zero(), 1), 3);
  EXPECT_THAT(message(scene), testing::HasSubstr("shape 1 names BSDF 3 of 1"));

  Scene flat;
  flat.bsdfs.push_back(Lambert{});
  flat.add(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}), 0, AreaLight{-1, Spectrum::Ones()});
  EXPECT_THAT(message(flat), testing::HasSubstr("light 0 is shape 0 of area 0"));

  const Float nan = std::numeric_limits<Float>::quiet_NaN();
  for (const Float bad : {Float(-1), nan, mc::infinity<Float>})
    EXPECT_THAT(message(one_sphere(Spectrum(1, bad, 1))), testing::HasSubstr("light 0 has radiance"));

  for (const Bsdf& wrong :
       {Bsdf(Lambert{Spectrum(1, nan, 1)}), Bsdf(Metal{Spectrum::Ones(), Float(1.5)}), Bsdf(Dielectric{0})}) {
    Scene s = one_sphere();
    s.bsdfs[0] = wrong;
    EXPECT_THAT(message(s), testing::HasSubstr("scene: BSDF 0: "));
  }
  Scene guided = one_sphere();
  guided.guides = {7};
  EXPECT_THAT(message(guided), testing::HasSubstr("the guides name shape 7"));
  Scene unlit = one_sphere();
  unlit.shape_light[0] = 2;
  EXPECT_THAT(message(unlit), testing::HasSubstr("names light 2"));

  Scene missing = one_sphere();
  missing.shape_bsdf.clear();
  EXPECT_THAT(message(missing), testing::HasSubstr("every shape needs"));
}

// Power 1 : 0 : 3 : 4 (two-sided counts twice); exact at the joints and the ends of the unit interval.
TEST(Scene, LightsAreChosenByPower) {
  Scene scene;
  scene.bsdfs.push_back(Lambert{});
  const auto add = [&](Float radiance, bool two_sided = false) {
    scene.add(Sphere(Vec3d(double(scene.shapes.size()), 0, 0), 1), 0,
              AreaLight{-1, Spectrum::Constant(radiance), two_sided});
  };
  add(1), add(0), add(3), add(2, true), add(0);
  scene.prepare();
  const Float expected[] = {Float(0.125), 0, Float(0.375), Float(0.5), 0};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(scene.light_pmf(i), expected[i], 1e-6);
  int counts[5] = {};
  for (int i = 0; i < 8000; ++i) {
    const auto [light, pmf] = scene.choose_light((Float(i) + Float(0.5)) / 8000);
    ++counts[light];
    EXPECT_EQ(pmf, scene.light_pmf(light));
  }
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(counts[i], 8000 * double(expected[i]), 1) << i;
  EXPECT_EQ(scene.choose_light(0).light, 0);
  EXPECT_EQ(scene.choose_light(mc::one_minus_epsilon<Float>).light, 3);
}

} // namespace
