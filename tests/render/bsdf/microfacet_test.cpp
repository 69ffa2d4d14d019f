#include <render/bsdf/microfacet.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Microfacets, MaskingIsThatOfTheTangent) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double theta : {0.0, 0.7, 1.5}) {
      const Vec3 w = Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>();
      const double g1 = 2 / (1 + std::sqrt(1 + mc::sqr(alpha * std::tan(theta))));
      EXPECT_NEAR(double(Microfacets(Float(alpha)).g1_over_cos(w)) * std::cos(theta), g1, 1e-5)
          << alpha << " " << theta;
    }
}

TEST(Microfacets, RoughnessHasARange) {
  EXPECT_EQ(checked_alpha("x", Float(0.5)), Float(0.5));
  for (const Float bad : {Float(0), Float(-1), Float(1.5), std::numeric_limits<Float>::quiet_NaN()})
    EXPECT_THROW(checked_alpha("x", bad), mc::Error);
}

} // namespace
