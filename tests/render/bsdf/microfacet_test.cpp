#include <render/bsdf/microfacet.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

#include "support/files.h"

namespace {

using namespace render;

TEST(TrowbridgeReitzFacets, MaskingIsThatOfTheTangent) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double theta : {0.0, 0.7, 1.5}) {
      const Vec3 w = Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>();
      const double g1 = 2 / (1 + std::sqrt(1 + mc::sqr(alpha * std::tan(theta))));
      EXPECT_NEAR(double(TrowbridgeReitzFacets(Float(alpha)).g1_over_cos(w)) * std::cos(theta), g1, 1e-5)
          << alpha << " " << theta;
    }
}

// The integral of D cos over the hemisphere, by the midpoint rule in 1 - cos = t^4, which spreads the peak.
TEST(BlinnPhongFacets, FillTheSurface) {
  for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
    const BlinnPhongFacets facets{Float(alpha)};
    const double n = 2 / (alpha * alpha) - 2;
    constexpr int steps = 20'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps, z = 1 - std::pow(t, 4);
      const Vec3 m = Vec3d(std::sqrt((1 - z) * (1 + z)), 0, z).cast<Float>();
      sum += double(facets.d(m)) * z * 2 * mc::pi<double> * 4 * std::pow(t, 3) / steps;
      const double d = (n + 2) / (2 * mc::pi<double>)*std::pow(z, n);
      EXPECT_NEAR(facets.d(m) / (d + 1e-15), d / (d + 1e-15), 1e-3) << alpha << " " << z;
    }
    EXPECT_NEAR(sum, 1, 1e-4) << alpha;
  }
}

// Grooves occlude nothing at normal incidence. The visible part of a facet that faces away goes to 0.
TEST(BlinnPhongFacets, HideEachOtherInGrooves) {
  const BlinnPhongFacets facets{Float(0.5)};
  const Vec3 z = Vec3::UnitZ();
  EXPECT_NEAR(facets.dg_over_cosines(z, z, z), facets.d(z), 1e-6);
  for (const double theta : {0.3, 0.9, 1.4, 1.57}) {
    const Vec3 w = Vec3d(std::sin(theta), 0, std::cos(theta)).cast<Float>(), m = (w + z).normalized();
    const double g = std::min(1.0, 2 * double(m.z()) * double(w.z()) / double(w.dot(m)));
    EXPECT_NEAR(facets.dg_over_cosines(w, z, m) / (double(facets.d(m)) * g / double(w.z())), 1, 1e-4) << theta;
    EXPECT_NEAR(facets.dg_over_cosines(z, w, m) / facets.dg_over_cosines(w, z, m), 1, 1e-6);
  }
}

// The direction stays the same, with length 1 in double, for any small component.
TEST(UnitInDouble, KeepsTheSmallerPart) {
  mc::Pcg random(3);
  for (int i = 0; i < 1000; ++i) {
    Vec3d v = mc::UniformSphere<double>{}.sample({random.uniform<double>(), random.uniform<double>()});
    const double flat = std::pow(10, -6 * random.uniform<double>());
    if (i % 2) v.z() *= flat;
    else v.head<2>() *= flat;
    const Vec3 w = v.normalized().cast<Float>();
    const Vec3d n = unit_in_double(w);
    EXPECT_NEAR(n.norm(), 1, 1e-15);
    EXPECT_LE((n - w.cast<double>()).norm(), 4 * double(std::numeric_limits<Float>::epsilon()));
    if (std::abs(w.z()) < 0.5) {
      EXPECT_EQ(n.z(), double(w.z()));
    } else if (std::abs(w.z()) > 0.8) {
      EXPECT_EQ(n.x(), double(w.x()));
    }
  }
  EXPECT_EQ(unit_in_double(Vec3(0, 0, -1)), Vec3d(0, 0, -1));
}

TEST(TrowbridgeReitzFacets, RoughnessHasARange) {
  for (const Float good : {Float(1e-4), Float(0.5), Float(1)}) {
    EXPECT_EQ(TrowbridgeReitzFacets(good).alpha(), good);
    EXPECT_EQ(BlinnPhongFacets(good).alpha(), good);
  }
  for (const Float bad :
       {Float(0), Float(5e-5), Float(-0.5), Float(1.5), Float(50), std::numeric_limits<Float>::quiet_NaN()}) {
    const std::string refusal = fmt::format("facets: alpha {} must lie in [0.0001, 1]", bad);
    EXPECT_EQ(support::error_of([&] { TrowbridgeReitzFacets{bad}; }), refusal);
    EXPECT_EQ(support::error_of([&] { BlinnPhongFacets{bad}; }), refusal);
  }
}

} // namespace
