#include <render/bsdf/thin_dielectric.h>

#include <mc/check/bsdf_laws.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include "render/bsdf/albedo.h"
#include "support/files.h"

namespace {

using namespace render;

TEST(ThinDielectric, ObeysTheLaws) {
  for (const double eta : {1.0, 1.5, 0.7})
    for (const double angle : {0.0, 60.0, 89.9, 120.0}) {
      const auto report = mc::check_bsdf<Float>(ThinDielectric(Float(eta)), support::at_degrees(angle),
                                                {.statistics = {.samples = 50'000, .alpha = 1e-5}});
      EXPECT_TRUE(report.passed()) << eta << ", " << angle << " degrees\n" << report.to_string();
    }
}

// A path that bounces between the two surfaces of a pane, each crossed as a Dielectric crosses it.
TEST(ThinDielectric, IsTheLimitOfTwoSurfaces) {
  mc::Pcg random(3);
  const Dielectric surface(Float(1.5));
  for (const double angle : {20.0, 75.0}) {
    const Vec3 wo = support::at_degrees(angle);
    constexpr int paths = 200'000;
    int reflected = 0;
    for (int i = 0; i < paths; ++i) {
      const auto refract = [&](const Vec3& w) { return surface.sample(w, random.uniform<Float>(), Vec2::Zero()); };
      auto step = refract(wo);
      bool is_inside = step->wi.z() < 0, goes_down = is_inside;
      while (is_inside) { // arrives from inside at one of the surfaces, whose normal points outward
        step = refract(Vec3(step->wi.x(), step->wi.y(), -std::abs(step->wi.z())));
        is_inside = step->wi.z() < 0;
        if (is_inside) goes_down = !goes_down;
      }
      reflected += !goes_down;
    }
    const auto one = ThinDielectric(Float(1.5)).sample(wo, Float(0.5), Vec2::Zero());
    const double r = one->wi.z() > 0 ? double(one->pdf) : 1 - double(one->pdf);
    const double share = double(reflected) / paths;
    EXPECT_NEAR(share, r, 4.5 * std::sqrt(r * (1 - r) / paths)) << angle;
  }
}

TEST(ThinDielectric, RefusesNonsense) {
  EXPECT_EQ(support::error_of([] { ThinDielectric(Float(-1)); }),
            "thin dielectric: relative index -1 must lie in [0.001, 1000]");
  EXPECT_THROW(ThinDielectric(Float(1.5), Spectrum::Constant(2)), mc::Error);
}

} // namespace
