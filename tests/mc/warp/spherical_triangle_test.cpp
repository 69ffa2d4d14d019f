#include <mc/warp/spherical_triangle.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class SphericalTriangleOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SphericalTriangleOver, Scalars);

// Edges of 1e-4 at distance 1 subtend 5e-9 sr. Aspect ratios 1 and 20 in both orientations.
TYPED_TEST(SphericalTriangleOver, ObeysTheLawsFromHugeToTiny) {
  using S = TypeParam;
  for (const double edge : {30.0, 1.0, 0.1, 1e-2, 1e-4})
    for (const double aspect : {1.0, -0.05}) {
      const SphericalTriangle<S> warp(Vec3<S>(S(0.3), S(-0.2), S(0.9)), Vec3<S>(S(edge), S(0.1 * edge), S(-0.2 * edge)),
                                      Vec3<S>(S(0.3 * edge), S(aspect * edge), S(0.05 * edge)));
      EXPECT_WARP_LAWS(warp, {.name = fmt::format("edge {}, aspect {}", edge, aspect),
                              .statistics = {.samples = edge >= 1 ? 20'000u : 0u},
                              .invert_eps = 6400 / std::min(1.0, edge) / std::abs(aspect),
                              .sample_eps = edge > 1 ? 64.0 : 16.0,
                              .pdf_eps = 16});
    }
}

TEST(SphericalTriangle, OctantIsHalfPi) {
  const SphericalTriangle<double> octant({1, 0, 0}, {-1, 1, 0}, {-1, 0, 1});
  EXPECT_NEAR(octant.solid_angle(), std::numbers::pi / 2, 1e-15);
}

TEST(SphericalTriangle, RefusesDegenerateTriangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((SphericalTriangle<double>({0, 0, 1}, {1, 0, 0}, {2, 0, 0})), Error);
  EXPECT_THROW((SphericalTriangle<double>({0, 0, 1}, {1, 0, 0}, {0, 0, 1})), Error);
  EXPECT_THROW((SphericalTriangle<double>({0, 0, nan}, {1, 0, 0}, {0, 1, 0})), Error);
}

} // namespace
} // namespace mc
