#include <mc/warp/beckmann.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class BeckmannNormalsOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BeckmannNormalsOver, Scalars);

// r^2 stays below 6 for 256 random u, so the bound (8 + 8 r^2) eps stays below 56.
TYPED_TEST(BeckmannNormalsOver, ObeysTheLaws) {
  using S = TypeParam;
  for (const double a : {1e-4, 1e-2, 0.3, 1.0}) {
    const BeckmannNormals<S> warp(S(a), S(0.5 * a));
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("alpha {}", a),
                            .statistics = {.samples = a >= 0.3 ? 50'000u : 0u},
                            .invert_eps = 16,
                            .sample_eps = 16,
                            .pdf_eps = 56});
  }
}

template <class S> Vec3<S> at(double degrees) {
  const double t = degrees * std::numbers::pi / 180, sine = std::sin(t);
  return Vec3<double>(0.8 * sine, 0.6 * sine, degrees == 90 ? 0.0 : std::cos(t)).cast<S>();
}

TYPED_TEST(BeckmannNormalsOver, VisibleNormalsObeyTheLawsAtEveryIncidence) {
  using S = TypeParam;
  for (const double a : {1e-4, 1e-2, 0.3, 1.0})
    for (const double degrees : {0.0, 0.01, 45.0, 89.9, 90.0}) {
      const BeckmannVisibleNormals<S> warp(at<S>(degrees), S(a), S(a < 0.1 ? 30 * a : 0.5 * a));
      EXPECT_WARP_LAWS(warp, {.name = fmt::format("visible, alpha {}, {} degrees", a, degrees),
                              .statistics = {.samples = a >= 0.3 ? 50'000u : 0u},
                              .invert_eps = 8,
                              .sample_eps = 64,
                              .pdf_eps = 64});
    }
}

TYPED_TEST(BeckmannNormalsOver, EveryVisibleNormalHasADensity) {
  using S = TypeParam;
  Pcg random(1);
  for (const double a : {1e-4, 0.1, 1.0})
    for (const double degrees : {0.0, 45.0, 89.99, 90.0}) {
      const BeckmannVisibleNormals<S> warp(at<S>(degrees), S(a));
      for (int i = 0; i < 10'000; ++i) {
        // Half of the points have u1 near 1, where facets are seen edge-on.
        Vec2<S> u = random.point<S, 2>();
        if (i % 2) u[1] = std::min(S(1 - u[1] * S(1e-5)), one_minus_epsilon<S>);
        const S pdf = warp.pdf(warp.sample(u));
        ASSERT_TRUE(pdf > 0 && std::isfinite(pdf)) << a << " " << degrees << " u " << u.transpose();
      }
    }
}

// The projected area is the mean of max(wo.m, 0) / m_z over all normals, by 2^18 points of a lattice, and the density
// of reflections contains the Jacobian.
TEST(BeckmannVisibleNormals, AreaIsTheIntegralOfVisibleFacets) {
  for (const double degrees : {10.0, 60.0, 85.0, 90.0})
    for (const double alpha : {0.1, 0.5, 1.0}) {
      const BeckmannVisibleNormals<double> warp(at<double>(degrees), alpha, 0.5 * alpha);
      const BeckmannNormals<double> all(alpha, 0.5 * alpha);
      constexpr int n = 512;
      double sum = 0;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const Vec3<double> m = all.sample({(i + 0.5) / n, (j + 0.5) / n});
          sum += std::max(warp.wo().dot(m), 0.0) / m.z();
        }
      EXPECT_NEAR(warp.area(), sum / (n * n), 2e-4) << degrees << " " << alpha;
      const Vec3<double> m = warp.sample({0.3, 0.6});
      EXPECT_NEAR(warp.pdf_reflected(m), warp.pdf(m) / (4 * warp.wo().dot(m)), 1e-14 * warp.pdf_reflected(m));
    }
}

// The powers of m_z underflow here, and the tail does so earlier.
TEST(BeckmannNormals, DensityNextToTheHorizonIsZero) {
  for (const double z : {1e-5, 1e-150, 1e-300}) EXPECT_EQ(mc::BeckmannNormals<double>(0.3).pdf({1, 0, z}), 0) << z;
}

TEST(BeckmannVisibleNormals, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double a : {0.0, -1.0, 1e-7, nan}) EXPECT_THROW((BeckmannVisibleNormals<double>({0, 0, 1}, a)), Error);
  for (const double z : {-1.0, 2.0, nan}) EXPECT_THROW((BeckmannVisibleNormals<double>({0, 0, z}, 0.1)), Error);
}

TEST(BeckmannNormals, RefusesNonsense) {
  for (const double a : {0.0, -1.0, 1e-7, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(BeckmannNormals<double>(a, 0.1), Error);
    EXPECT_THROW(BeckmannNormals<double>(0.1, a), Error);
  }
}

} // namespace
} // namespace mc
