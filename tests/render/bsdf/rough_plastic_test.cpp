#include <render/bsdf/rough_plastic.h>

#include <mc/check/bsdf_laws.h>

#include <gtest/gtest.h>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

RoughPlastic plastic(double alpha) {
  return RoughPlastic(Float(1.49), Float(alpha), Spectrum(Float(0.1), Float(0.5), Float(0.3)), Spectrum::Ones());
}

// Directions on both sides at alpha = 1e-5 each.
TEST(RoughPlastic, ObeysTheLaws) {
  for (const double alpha : {0.02, 0.3, 1.0})
    for (const double angle : {0.0, 60.0, 85.0, 120.0}) {
      const Vec3 wo = support::at_degrees(angle);
      const auto report = mc::check_bsdf<Float>(plastic(alpha), wo, {.samples = 50'000, .alpha = 1e-5});
      EXPECT_TRUE(report.passed()) << alpha << ", " << angle << " degrees\n" << report.to_string();
    }
}

// Of the coat alone, relative index 1.49: by an independent quadrature and 4e5 samples of another program, +- .0005.
TEST(RoughPlastic, DirectionalAlbedos) {
  struct Row {
    double alpha, at_09, at_05, at_02;
  };
  for (const Row& row : {Row{0.1, 0.0395, 0.0842, 0.2341}, Row{0.3, 0.0357, 0.0593, 0.1099},
                         Row{0.6, 0.0246, 0.0358, 0.0572}, Row{1, 0.0133, 0.0203, 0.0321}}) {
    const RoughPlastic coat(Float(1.49), Float(row.alpha), Spectrum::Zero(), Spectrum::Ones());
    EXPECT_NEAR(support::albedo(coat, 0.9), row.at_09, 0.0008) << row.alpha;
    EXPECT_NEAR(support::albedo(coat, 0.5), row.at_05, 0.0008) << row.alpha;
    EXPECT_NEAR(support::albedo(coat, 0.2), row.at_02, 0.0008) << row.alpha;
  }
}

// What the contract says of its gain: light for the base is not kept away by a coat that reflects all.
TEST(RoughPlastic, GainsAtGrazingAngles) {
  const RoughPlastic paint(Float(1.49), Float(1e-4), Spectrum::Constant(Float(0.5)), Spectrum::Ones());
  EXPECT_NEAR(support::albedo(paint, 0.03), 1.27, 0.01);
  EXPECT_NEAR(support::albedo(paint, 0.00174533), 1.4, 0.05);
}

TEST(RoughPlastic, RefusesNonsense) {
  const Spectrum one = Spectrum::Ones();
  EXPECT_THROW(RoughPlastic(0, Float(0.1), one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), 0, one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), Float(0.1), 2 * one, one), mc::Error);
  EXPECT_THROW(RoughPlastic(Float(1.5), Float(0.1), one, -one), mc::Error);
}

} // namespace
