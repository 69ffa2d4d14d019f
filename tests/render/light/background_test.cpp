#include <render/light/background.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(ConstantBackground, IsTheSameEverywhere) {
  const ConstantBackground sky(Spectrum::Constant(2));
  EXPECT_TRUE((sky.Le(Vec3::UnitX(), nullptr) == 2).all());
  const SurfacePoint p;
  EXPECT_TRUE(is_black(sky.Le(Vec3::UnitX(), &p))) << "it does not shine through surfaces";
  EXPECT_EQ(sky.pdf(Vec3::Zero(), Vec3::UnitX(), &p), 0);
  // A ball of radius 3 has a disk of area 9 pi in every direction, with radiance 2 over 4 pi sr.
  EXPECT_NEAR(sky.power(3) / (mc::pi<double> * 9 * 4 * mc::pi<double> * 2), 1, 1e-6);
}

TEST(GradientBackground, IsLinearInHeight) {
  const GradientBackground sky(Spectrum::Ones(), Spectrum(Float(0.5), Float(0.25), 0));
  EXPECT_TRUE((sky.Le(-Vec3::UnitY(), nullptr) == 1).all());
  EXPECT_TRUE((sky.Le(Vec3::UnitY(), nullptr) == Spectrum(Float(0.5), Float(0.25), 0)).all());
  EXPECT_TRUE((sky.Le(Vec3::UnitX(), nullptr) == Spectrum(Float(0.75), Float(0.625), Float(0.5))).all());
}

// Luminance over density is constant: the mean luminance times 4 pi.
TEST(GradientBackground, IsSampledByLuminance) {
  const GradientBackground sky;
  const double expected = sky.power(1) / mc::pi<double>;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const auto s = sky.sample(Vec3::Zero(), Vec2((Float(i) + Float(0.5)) / 20, (Float(j) + Float(0.5)) / 20));
      ASSERT_TRUE(s);
      EXPECT_NEAR(double(luminance(s->radiance)) / double(s->pdf) / expected, 1, 1e-5);
      EXPECT_FALSE(s->point);
    }
}

TEST(Background, RefusesNonsense) {
  const Float nan = std::numeric_limits<Float>::quiet_NaN();
  for (const Float bad : {Float(-1), nan, mc::infinity<Float>}) {
    EXPECT_THROW(ConstantBackground(Spectrum(1, bad, 1)), mc::Error);
    EXPECT_THROW(GradientBackground(Spectrum(1, bad, 1)), mc::Error);
    EXPECT_THROW(GradientBackground(Spectrum::Ones(), Spectrum(bad, 1, 1)), mc::Error);
  }
  EXPECT_NO_THROW(GradientBackground(Spectrum::Zero(), Spectrum::Zero()));
}

} // namespace
