#include <mc/warp/trowbridge_reitz.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> Vec3<S> at(double degrees, double phi) {
  const double t = degrees * std::numbers::pi / 180;
  return Vec3<double>(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), degrees == 90 ? 0.0 : std::cos(t))
      .cast<S>();
}

template <class S> class TrowbridgeReitz : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TrowbridgeReitz, Scalars);

// For the deterministic laws: edges, inverse, Jacobian, 50 digits. The statistical tests run over the catalogue.
constexpr std::uint64_t few = 50'000;

TYPED_TEST(TrowbridgeReitz, NormalsObeyTheLaws) {
  using S = TypeParam;
  for (const double a : {1e-4, 1e-3, 0.1, 1.0}) {
    const double other = a < 1e-3 ? 1e-2 : 0.5 * a;
    const TrowbridgeReitzNormals<S> warp{S(a), S(other)};
    EXPECT_WARP_LAWS(warp, {.name = fmt::format("alpha {}", a),
                            .statistics = {.samples = a >= 0.1 ? few : 0},
                            .invert_eps = 16,
                            .pdf_eps = 16});
  }
}

TYPED_TEST(TrowbridgeReitz, VisibleNormalsObeyTheLawsAtEveryIncidence) {
  using S = TypeParam;
  for (const double a : {1e-4, 1e-3, 0.1, 1.0})
    for (const double degrees : {0.0, 0.01, 45.0, 89.9, 90.0}) {
      const TrowbridgeReitzVisibleNormals<S> warp(at<S>(degrees, 0.7), S(a), S(0.3 * a));
      EXPECT_WARP_LAWS(warp, {.name = fmt::format("alpha {}, {} degrees", a, degrees),
                              .statistics = {.samples = a == 1 ? few : 0},
                              .invert_eps = 512,
                              .sample_eps = 64,
                              .pdf_eps = 16});
    }
}

TYPED_TEST(TrowbridgeReitz, EveryVisibleNormalHasADensity) {
  using S = TypeParam;
  Pcg random(1);
  for (const double a : {1e-4, 1e-3, 0.1, 1.0})
    for (const double degrees : {0.0, 45.0, 89.99, 90.0}) {
      const TrowbridgeReitzVisibleNormals<S> warp(at<S>(degrees, 2.0), S(a));
      for (int i = 0; i < 50000; ++i) {
        // Half of the points have u1 near 1, where reflections leave along the surface.
        Vec2<S> u = random.point<S, 2>();
        if (i % 2) u[1] = std::min(S(1 - u[1] * S(1e-5)), one_minus_epsilon<S>);
        const S pdf = warp.pdf(warp.sample(u));
        ASSERT_TRUE(pdf > 0 && std::isfinite(pdf)) << a << " " << degrees << " u " << u.transpose();
      }
    }
}

TEST(TrowbridgeReitzNormal, ReflectedDensityIsTheJacobianTimesTheNormals) {
  const TrowbridgeReitzVisibleNormals<double> warp(at<double>(60, 1), 0.2, 0.4);
  const Vec3<double> m = warp.sample({0.3, 0.6});
  EXPECT_NEAR(warp.pdf_reflected(m), warp.pdf(m) / (4 * warp.wo().dot(m)), 1e-14 * warp.pdf_reflected(m));
}

TEST(TrowbridgeReitzNormal, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double a : {0.0, -1.0, nan, 1e-7}) {
    EXPECT_THROW(TrowbridgeReitzNormals<double>(a, 0.1), Error);
    EXPECT_THROW(TrowbridgeReitzNormals<double>(0.1, a), Error);
    EXPECT_THROW((TrowbridgeReitzVisibleNormals<double>({0, 0, 1}, a)), Error);
  }
  EXPECT_THROW((TrowbridgeReitzVisibleNormals<double>({0, 0, -1}, 0.1)), Error);
  EXPECT_THROW((TrowbridgeReitzVisibleNormals<double>({0, 0, 2}, 0.1)), Error);
  EXPECT_THROW((TrowbridgeReitzVisibleNormals<double>({0, 0, nan}, 0.1)), Error);
}

} // namespace
} // namespace mc
