#include <render/integrator/shading_point.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// A point whose normals differ by an angle.
SurfacePoint tilted(double degrees) {
  const double angle = degrees * mc::pi<double> / 180;
  SurfacePoint point;
  point.p = Vec3::Zero();
  point.ng = Vec3::UnitZ();
  point.ns = Vec3(Float(std::sin(angle)), 0, Float(std::cos(angle)));
  return point;
}

Vec3 at_degrees(double theta) {
  const double angle = theta * mc::pi<double> / 180;
  return Vec3d(std::sin(angle), 0, std::cos(angle)).cast<Float>();
}

TEST(ShadingFrame, IsThatOfTheShadingNormal_UnlessItFacesAway) {
  const SurfacePoint point = tilted(30);
  for (const double theta : {-59.0, 0.0, 80.0, 130.0}) {
    const ShadingFrame frame(point, at_degrees(theta));
    EXPECT_FALSE(frame.is_bent()) << theta;
    EXPECT_LE((frame.to_world(Vec3::UnitZ()) - point.ns).norm(), 1e-6) << theta;
  }
  // The viewer is above the surface and below the horizon of the shading normal, or the reverse.
  for (const double theta : {-61.0, -75.0, -89.9, 105.0, 91.0}) {
    const Vec3 wo = at_degrees(theta);
    const ShadingFrame frame(point, wo);
    EXPECT_TRUE(frame.is_bent()) << theta;
    EXPECT_NEAR(frame.to_local(wo).z(), std::copysign(ShadingFrame::least_cosine, wo.z()), 5e-4) << theta;
    EXPECT_GT(frame.to_world(Vec3::UnitZ()).dot(point.ng), 0) << theta;
  }
  EXPECT_FALSE(ShadingFrame(tilted(0), at_degrees(89.99)).is_bent());
}

// The samples leave on the side that the BSDF says, have the density pdf(), and carry f_cos() / pdf(). The density
// integrates to the share of samples.
template <class B> void expect_consistent(const B& bsdf, bool transmits) {
  mc::Pcg random(5);
  for (const double tilt : {0.0, 20.0, 60.0})
    for (const double theta : {-80.0, -40.0, 0.0, 70.0, 125.0}) {
      const SurfacePoint point = tilted(tilt);
      const ShadingPoint<B> at(bsdf, point, at_degrees(theta));
      const int n = 20'000;
      int kept = 0;
      mc::Moments mass;
      for (int i = 0; i < n; ++i) {
        const Float uc = random.uniform<Float>();
        const auto s = at.sample(uc, random.point<Float, 2>());
        const Vec3 w = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
        mass.add(double(at.pdf(w)) * 4 * mc::pi<double>);
        if (!s) continue;
        ++kept;
        ASSERT_TRUE(transmits || at.frame.same_side(at.wo, s->wi)) << tilt << ", " << theta;
        ASSERT_NEAR(at.pdf(s->wi) / s->pdf, 1, 2e-3) << tilt << ", " << theta;
        ASSERT_LE((at.f_cos(s->wi) - s->f_cos).abs().maxCoeff(), 2e-3 * s->f_cos.maxCoeff()) << tilt << ", " << theta;
      }
      const double share = double(kept) / n;
      EXPECT_NEAR(mass.mean(), share, 5 * (mass.std_error() + 0.5 / std::sqrt(double(n)))) << tilt << ", " << theta;
    }
}

TEST(ShadingPoint, SampleHasItsDensityAndValue) {
  expect_consistent(Lambert(Spectrum(1, Float(0.5), Float(0.2))), false);
  expect_consistent(RoughPlastic(Float(1.5), Float(0.4), Spectrum::Constant(Float(0.5)), Spectrum::Ones()), false);
  expect_consistent(RoughDielectric(Float(1.5), Float(0.5)), true);
}

// No light is lost: a white surface reflects all light, from every direction and for every pair of normals.
TEST(ShadingPoint, WhiteSurfaceReflectsAllLight) {
  mc::Pcg random(6);
  const Lambert white(Spectrum::Ones());
  for (const double tilt : {0.0, 20.0, 60.0, 85.0})
    for (const double theta : {-89.0, -50.0, 0.0, 89.0, 100.0, 179.0}) {
      const SurfacePoint point = tilted(tilt);
      const ShadingPoint<Lambert> at(white, point, at_degrees(theta));
      for (int i = 0; i < 100; ++i) {
        const auto s = at.sample(0, random.point<Float, 2>());
        ASSERT_TRUE(s);
        EXPECT_NEAR(s->f_cos[0] / s->pdf, 1, 1e-5) << tilt << ", " << theta;
        EXPECT_TRUE(at.frame.same_side(at.wo, s->wi)) << tilt << ", " << theta;
      }
    }
}

// Mirrored directions of a mirror, and those of a bent frame, cannot be taken in reverse.
TEST(ShadingPoint, DeltaLobe_SaysWhetherItIsReversible) {
  const SmoothConductor mirror(Spectrum::Zero(), Spectrum::Ones());
  const auto sample = [&](double tilt, double theta) {
    const SurfacePoint point = tilted(tilt);
    const ShadingPoint<SmoothConductor> at(mirror, point, at_degrees(theta));
    const auto s = at.sample(0, {0, 0});
    EXPECT_TRUE(s && at.frame.same_side(at.wo, s->wi));
    return std::pair(at.frame.to_world(s->wi), s->reversible);
  };
  const auto [straight, is_reversible] = sample(30, 10);
  EXPECT_LE((straight - at_degrees(50)).norm(), 1e-5);
  EXPECT_TRUE(is_reversible);
  const auto [mirrored, mirrored_is_reversible] = sample(30, -50); // mirrored to 110 degrees, below the surface
  EXPECT_LE((mirrored - at_degrees(70)).norm(), 1e-5);
  EXPECT_FALSE(mirrored_is_reversible);
  EXPECT_FALSE(sample(30, -70).second); // the normal is bent
}

// A path that arrives from wi sees the same vertex, with a normal that is bent for wi.
TEST(ShadingPoint, ReverseExchangesDirections) {
  const RoughPlastic paint(Float(1.5), Float(0.4), Spectrum::Constant(Float(0.5)), Spectrum::Ones());
  for (const double tilt : {0.0, 30.0}) {
    const SurfacePoint point = tilted(tilt);
    const Vec3 d = at_degrees(-70), e = at_degrees(40);
    const ShadingPoint at(paint, point, d), direct(paint, point, e);
    const auto reverse = at.reverse(at.frame.to_local(e));
    EXPECT_NEAR(reverse.at.pdf(reverse.wi), direct.pdf(direct.frame.to_local(d)), 1e-5);
    EXPECT_NEAR(reverse.at.f_cos(reverse.wi)[1], direct.f_cos(direct.frame.to_local(d))[1], 1e-5);
  }
}

} // namespace
