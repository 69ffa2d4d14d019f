#include <render/bsdf/bsdf.h>
#include <render/integrator/mis_weights.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

/// Vertices of a path, with the densities of all directions by paths from either end.
struct Chain {
  std::vector<Vec3d> points, normals;
  /// [1/sr]; onward[i] for the edge from i to i + 1, back[i] for the edge from i to i - 1
  std::vector<double> onward, back;

  Chain(mc::Pcg& random, std::size_t n) {
    const auto number = [&] { return std::exp(4 * random.uniform<double>() - 2); };
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back(10 * random.point<double, 3>());
      normals.push_back(mc::UniformSphere<double>{}.sample(random.point<double, 2>()));
      onward.push_back(number());
      back.push_back(number());
    }
  }
  double cosine(std::size_t i, std::size_t j) const {
    return std::abs(normals[i].dot((points[j] - points[i]).normalized()));
  }
  double distance2(std::size_t i, std::size_t j) const { return (points[j] - points[i]).squaredNorm(); }
  // Density per area at vertex j of a direction from vertex i with density pdf.
  double per_area(double pdf, std::size_t i, std::size_t j) const { return pdf * cosine(j, i) / distance2(i, j); }
};

// The ratio equals the product of its definition, for paths of up to nine vertices.
TEST(PartialMisWeight, EqualsRatioOfPathPdfs) {
  mc::Pcg random(4);
  for (int run = 0; run < 200; ++run) {
    const std::size_t n = 3 + std::size_t(7 * random.uniform<double>());
    const Chain c(random, n);
    const double first = random.uniform<double>();
    PartialMisWeight partial_mis(first, c.onward[0], c.cosine(0, 1));
    double expected = first;
    for (std::size_t i = 1; i < n; ++i) {
      partial_mis.add_vertex(c.cosine(i, i - 1), c.distance2(i, i - 1));
      expected /= mc::sqr(c.per_area(c.onward[i - 1], i - 1, i));
      const double with = expected * mc::sqr(c.per_area(c.back[i], i, i - 1));
      EXPECT_NEAR(partial_mis.squared_ratio(mc::sqr(c.back[i])) / with, 1, 1e-9);
      if (i + 1 == n) break;
      partial_mis.scatter(mc::sqr(c.back[i]), c.onward[i], c.cosine(i, i + 1));
      expected = with;
    }
  }
}

// Light paths connect to the camera at the first vertex, so no direction back to it is sampled.
TEST(PartialMisWeight, FirstVertexFromCamera_HasNoReversePdf) {
  PartialMisWeight partial_mis(1, 3, 0);
  partial_mis.add_vertex_from_point(0.5, 4);
  EXPECT_NEAR(partial_mis.squared_ratio(1), mc::sqr(4 / (3 * 0.5)), 1e-12);
  EXPECT_EQ(partial_mis.squared_ratio(0), 0);
}

// Zero-length edges and grazing edges give ratios that are not NaN.
TEST(PartialMisWeight, ZeroLengthEdges_StayFinite) {
  for (const double cosine : {0.0, 1.0})
    for (const double distance2 : {0.0, 1e-90, 1e60}) {
      PartialMisWeight partial_mis(1, 1, cosine);
      partial_mis.add_vertex(cosine, distance2);
      EXPECT_FALSE(std::isnan(partial_mis.squared_ratio(1))) << cosine << " " << distance2;
    }
}

// Both directions through smooth glass have density 1, but their solid angles differ. n^2 cos domega is constant along
// thin cones, as the weights of the lobe state.
TEST(PartialMisWeight, NearSpecularLobe_ReversePdfs) {
  mc::Pcg random(6);
  const Dielectric glass(Float(1.5));
  for (int i = 0; i < 100; ++i) {
    const Vec3 wo = mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
    const auto s = glass.sample(wo, random.uniform<Float>(), {0, 0});
    if (!s || std::abs(wo.z()) < Float(0.01)) continue;
    const double there = near_specular_reverse_pdf(wo, s->wi, s->eta);
    const double back = near_specular_reverse_pdf(s->wi, wo, 1 / s->eta);
    EXPECT_NEAR(there * back, 1, 1e-5);
    EXPECT_NEAR(there, std::abs(wo.z() / s->wi.z()) / mc::sqr(s->eta), 1e-5);
  }
}

} // namespace
