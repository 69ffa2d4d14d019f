#include <render/bsdf/phase_function.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// cos is that of the deflection. f times the cosine to the frame's axis is the phase function.
TEST(PhaseFunction, IsHenyeyGreensteinAboutTheRay) {
  mc::Pcg random(1);
  for (const double g : {-0.6, 0.0, 0.9}) {
    const PhaseFunction phase{Float(g)};
    for (int i = 0; i < 100; ++i) {
      const auto direction = [&] {
        return Vec3(mc::UniformSphere<double>{}.sample(random.point<double, 2>()).cast<Float>());
      };
      const Vec3 wo = direction(), wi = direction();
      const double cosine = -wo.cast<double>().dot(wi.cast<double>());
      const double p = (1 - g * g) / (4 * mc::pi<double> * std::pow(1 + g * g - 2 * g * cosine, 1.5));
      EXPECT_NEAR(double(phase.pdf(wo, wi)), p, 1e-4 * p);
      EXPECT_NEAR(double(phase.eval(wo, wi)[1]) * std::abs(double(wi.z())), p, 1e-4 * p);
      const auto s = phase.sample(wo, 0, random.point<Float, 2>());
      ASSERT_TRUE(s);
      EXPECT_NEAR(double(s->f[0] * std::abs(s->wi.z()) / s->pdf), 1, 1e-5);
      EXPECT_NEAR(double(s->pdf), double(phase.pdf(wo, s->wi)), 1e-3 * double(s->pdf));
    }
  }
}

TEST(PhaseFunction, DirectionAcrossTheAxisIsFinite) {
  EXPECT_TRUE(PhaseFunction().eval(Vec3::UnitZ(), Vec3::UnitX()).isFinite().all());
  EXPECT_EQ((PhaseFunction().eval(Vec3::UnitZ(), Vec3::UnitX()) * Float(0)).maxCoeff(), 0);
}

TEST(PhaseFunction, RefusesMeanCosinesOfOneAndMore) {
  for (const double bad : {1.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(PhaseFunction{Float(bad)}, mc::Error) << bad;
}

} // namespace
