#include <render/bsdf/rough_dielectric.h>

#include <mc/check/bsdf_laws.h>

#include <gtest/gtest.h>

#include "render/bsdf/albedo.h"

namespace {

using namespace render;

// Directions on both sides at alpha = 1e-5 each.
template <class Facets> void expect_laws(const std::vector<double>& alphas) {
  for (const double alpha : alphas)
    for (const double angle : {0.0, 60.0, alpha < 1e-3 ? 89 : 89.9, 120.0, 150.0}) {
      const Vec3 wo = support::at_degrees(angle);
      const auto report = mc::check_bsdf<Float>(RoughDielectric<Facets>(Float(1.5), Float(alpha)), wo,
                                                {.statistics = {.samples = 50'000, .alpha = 1e-5}, .eta = 1.5});
      EXPECT_TRUE(report.passed()) << alpha << ", " << angle << " degrees\n" << report.to_string();
    }
}

TEST(RoughDielectric, ObeysTheLawsOnBothSides) { expect_laws<TrowbridgeReitzFacets>({1e-4, 1e-3, 0.1, 0.5}); }
TEST(RoughDielectric, ObeysTheLawsWithBeckmannFacets) { expect_laws<BeckmannFacets>({1e-4, 0.3}); }

// Directional albedos for the relative index 1.5046, without division of radiance by the squared index. They are from
// an independent quadrature and 4e5 samples of another program, +- .0005.
TEST(RoughDielectric, DirectionalAlbedos) {
  struct Row {
    double alpha;
    std::array<double, 3> outside, inside;
  };
  const std::array<double, 3> cosines = {0.9, 0.5, 0.2};
  for (const Row& row : {Row{0.1, {0.9984, 0.9922, 0.9506}, {0.9869, 0.9633, 0.8922}},
                         Row{0.3, {0.9845, 0.9469, 0.8832}, {0.8796, 0.7801, 0.7442}},
                         Row{0.6, {0.9419, 0.8434, 0.7023}, {0.6563, 0.5926, 0.5446}},
                         Row{1, {0.8610, 0.6723, 0.4788}, {0.4411, 0.4532, 0.3533}}}) {
    const RoughDielectric glass(Float(1.5046), Float(row.alpha));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(support::albedo(glass, cosines[i]), row.outside[i], 0.0015) << row.alpha << " " << cosines[i];
      EXPECT_NEAR(support::albedo(glass, -cosines[i]), row.inside[i], 0.0015) << row.alpha << " " << -cosines[i];
    }
  }
}

TEST(RoughDielectric, RefusesNonsense) {
  EXPECT_THROW(RoughDielectric(1, Float(0.1)), mc::Error);
  EXPECT_THROW(RoughDielectric(-1, Float(0.1)), mc::Error);
  EXPECT_THROW(RoughDielectric(Float(1.5), 2), mc::Error);
}

} // namespace
