#include <render/light/light.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(AreaLight, ShinesFromTheSideOfItsNormal) {
  const AreaLight light{0, Spectrum(1, 2, 3)};
  EXPECT_TRUE((light.emitted(Vec3::UnitY(), Vec3(1, 1, 0).normalized()) == light.radiance).all());
  EXPECT_TRUE((light.emitted(Vec3::UnitY(), Vec3(1, -1, 0).normalized()) == 0).all());
  EXPECT_TRUE((light.emitted(Vec3::UnitY(), Vec3::UnitX()) == 0).all());
}

TEST(AreaLight, TwoSidedShinesFromBoth) {
  const AreaLight light{0, Spectrum(1, 2, 3), true};
  for (const Float side : {Float(1), Float(-1)})
    EXPECT_TRUE((light.emitted(Vec3::UnitY(), side * Vec3::UnitY()) == light.radiance).all());
}

TEST(Background, ConstantAndGradient) {
  EXPECT_TRUE((Background(ConstantBackground{Spectrum::Constant(2)}).eval(Vec3::UnitX()) == 2).all());
  const Background sky = GradientBackground{Spectrum::Ones(), Spectrum(Float(0.5), Float(0.25), 0)};
  EXPECT_TRUE((sky.eval(-Vec3::UnitY()) == 1).all());
  EXPECT_TRUE((sky.eval(Vec3::UnitY()) == Spectrum(Float(0.5), Float(0.25), 0)).all());
  EXPECT_TRUE((sky.eval(Vec3::UnitX()) == Spectrum(Float(0.75), Float(0.625), Float(0.5))).all());
}

} // namespace
