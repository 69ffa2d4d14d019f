#include <mc/warp/half_vector.h>

#include <mc/gtest/matchers.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/trowbridge_reitz.h>

namespace mc {
namespace {

template <class S> Vec3<S> at(double degrees, double phi = 0.7) {
  const double t = degrees * std::numbers::pi / 180;
  return Vec3<double>(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), degrees == 90 ? 0.0 : std::cos(t))
      .cast<S>();
}

template <class S> class HalfVectorOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HalfVectorOver, Scalars);

// Options for the deterministic laws; the statistical tests run over the catalogue. Bounds that depend on the point are
// tested separately below.
LawOptions deterministic(std::string name, double sample_eps = 64, double pdf_eps = 64) {
  return {.name = std::move(name),
          .statistics = {.samples = 0},
          .points = 32,
          .invert_eps = HUGE_VAL,
          .sample_eps = sample_eps,
          .pdf_eps = pdf_eps};
}

TYPED_TEST(HalfVectorOver, ReflectionObeysTheLawsAtEveryRoughnessAndIncidence) {
  using S = TypeParam;
  for (const double alpha : {1e-4, 1.0})
    for (const double degrees : {0.0, 60.0, 89.9, 90.0})
      EXPECT_WARP_LAWS(Reflected(TrowbridgeReitzVisibleNormals<S>(at<S>(degrees), S(alpha), S(0.5 * alpha))),
                       deterministic(fmt::format("visible normals {}, {} degrees", alpha, degrees)));
  for (const double degrees : {60.0, 120.0}) // also from below
    EXPECT_WARP_LAWS(Reflected(at<S>(degrees), BeckmannNormals<S>(S(0.3))),
                     deterministic(fmt::format("Beckmann, {} degrees", degrees)));
}

TYPED_TEST(HalfVectorOver, RefractionObeysTheLawsAtEveryRoughnessAndIncidence) {
  using S = TypeParam;
  for (const double alpha : {1e-4, 1.0})
    for (const double degrees : {60.0, 90.0}) {
      const TrowbridgeReitzVisibleNormals<S> normals(at<S>(degrees), S(alpha));
      EXPECT_WARP_LAWS(RefractedIn(normals, S(1.5)),
                       deterministic(fmt::format("alpha {}, {} degrees", alpha, degrees), 64, HUGE_VAL));
    }
  EXPECT_WARP_LAWS(RefractedIn(TrowbridgeReitzVisibleNormals<S>(at<S>(80), S(0.3)), S(1.0003)),
                   deterministic("nearly equal media", 64, HUGE_VAL));
  EXPECT_WARP_LAWS(RefractedIn(TrowbridgeReitzVisibleNormals<S>(at<S>(80), S(0.3)), S(100)),
                   deterministic("a hundredfold denser medium", 64, HUGE_VAL));
  // The pole of the chart points up. From below, a narrow lobe leaves along it.
  EXPECT_WARP_LAWS(RefractedIn(Vec3<S>(0, 0, -1), TrowbridgeReitzNormals<S>(S(1e-4)), S(1.5)),
                   deterministic("from below"));
}

TYPED_TEST(HalfVectorOver, RefractionOutObeysTheLawsWhereItReflectsTotallyToo) {
  using S = TypeParam;
  for (const double alpha : {1e-2, 1.0})
    for (const double degrees : {30.0, 60.0, 90.0}) // the critical angle is 41.8 degrees
      EXPECT_WARP_LAWS(RefractedOut(TrowbridgeReitzVisibleNormals<S>(at<S>(degrees), S(alpha)), S(2) / 3),
                       deterministic(fmt::format("out, alpha {}, {} degrees", alpha, degrees), HUGE_VAL, HUGE_VAL));
}

// The contracts of RefractedIn and RefractedOut: sample and pdf against 50 digits, with the cosines of each sample.
TYPED_TEST(HalfVectorOver, RefractionIsAsPreciseAsItsCosines) {
  using S = TypeParam;
  const double eps = std::numeric_limits<S>::epsilon();
  const auto measure = [&](const auto& lobe, const auto& normals, double eta) {
    const auto exact = lobe.template cast<Oracle>();
    Pcg random(7);
    for (int i = 0; i < 150; ++i) {
      const Vec2<S> u = random.template point<S, 2>();
      const Vec3<S> m = normals.sample(u), wi = lobe.sample(u);
      const double c = double(normals.wo().dot(m)), cos_t2 = 1 - (1 - c * c) / (eta * eta),
                   cos_t = cos_t2 > 0 ? std::sqrt(cos_t2) : 1;
      const Vec3<Oracle> wide = exact.sample(cast_point<Oracle>(u));
      EXPECT_LE(double(Oracle((wide - cast_point<Oracle>(wi)).norm())), 64 * eps / cos_t) << c << ' ' << cos_t;
      const double ratio = double(Oracle(lobe.pdf(wi)) / exact.pdf(cast_point<Oracle>(wi)));
      EXPECT_LE(std::abs(ratio - 1), (64 + 4 / c + 4 / cos_t) * eps) << c << ' ' << cos_t;
    }
  };
  for (const double alpha : {1e-4, 1e-2, 1.0})
    for (const double degrees : {30.0, 89.9}) {
      const TrowbridgeReitzVisibleNormals<S> normals(at<S>(degrees), S(alpha));
      measure(RefractedIn(normals, S(1.5)), normals, 1.5);
      measure(RefractedOut(normals, S(2) / 3), normals, 2.0 / 3);
    }
}

// The conditioning described at the top of half_vector.h: the density from the direction, and the inverse, lose a
// factor 1 / (alpha |s|).
TYPED_TEST(HalfVectorOver, ConditioningIsAsStated) {
  using S = TypeParam;
  const double eps = std::numeric_limits<S>::epsilon();
  const auto measure = [&](const auto& lobe, const auto& normals, const Vec3<S>& wo, double alpha, double eta) {
    Pcg random(5);
    for (int i = 0; i < 20000; ++i) {
      const Vec2<S> u = random.template point<S, 2>();
      const Vec3<S> m = normals.sample(u), wi = lobe.direction(m);
      const double unit =
          eps * eta / (alpha * Vec3<double>(wo.template cast<double>() + eta * wi.template cast<double>()).norm());
      EXPECT_LE((lobe.invert(wi) - u).norm(), 16 * unit) << alpha << ' ' << eta;
      if (alpha <= 0.01) {
        EXPECT_LE(std::abs(lobe.pdf(wi) / lobe.pdf_at_normal(m) - 1), 8 * unit) << alpha << ' ' << eta;
      }
    }
  };
  for (const double alpha : {1e-4, 1e-2, 1.0})
    for (const double degrees : {0.0, 60.0}) {
      const TrowbridgeReitzNormals<S> normals{S(alpha)};
      measure(Reflected(at<S>(degrees), normals), normals, at<S>(degrees), alpha, 1);
      measure(RefractedIn(at<S>(degrees), normals, S(1.5)), normals, at<S>(degrees), alpha, 1.5);
    }
}

// The density at the normal against 50 digits: no loss at alpha = 1e-4.
TYPED_TEST(HalfVectorOver, DensityAtTheNormalLosesNothing) {
  using S = TypeParam;
  const double eps = std::numeric_limits<S>::epsilon();
  Pcg random(6);
  for (const double alpha : {1e-4, 0.5}) {
    const TrowbridgeReitzVisibleNormals<S> normals(at<S>(60), S(alpha));
    const Reflected reflected(normals);
    const RefractedIn refracted(normals, S(1.5));
    const auto exact = normals.template cast<Oracle>();
    for (int i = 0; i < 1000; ++i) {
      const Vec3<S> m = normals.sample(random.point<S, 2>());
      const Vec3<Oracle> wide = cast_point<Oracle>(m);
      const Oracle c = cast_point<Oracle>(normals.wo()).dot(wide), k = sqrt(Oracle(1.25 + c * c));
      EXPECT_NEAR(double(Oracle(reflected.pdf_at_normal(m)) * 4 * c / exact.pdf(wide)), 1, 32 * eps);
      EXPECT_NEAR(double(Oracle(refracted.pdf_at_normal(m)) / (exact.pdf(wide) * Oracle(1.5) * k / sqr<Oracle>(k - c))),
                  1, (32 + 8 / double(c)) * eps);
    }
  }
}

TEST(HalfVector, MirrorAndSnell) {
  const Vec3<double> wo = at<double>(40), up(0, 0, 1);
  const BeckmannNormals<double> normals(0.1);
  EXPECT_LE((Reflected(wo, normals).direction(up) - Vec3<double>(-wo.x(), -wo.y(), wo.z())).norm(), 4e-16);
  const Vec3<double> in = RefractedIn(wo, normals, 1.5).direction(up);
  EXPECT_NEAR(1.5 * std::hypot(in.x(), in.y()), std::sin(40 * pi<double> / 180), 4e-16);
  EXPECT_LT(in.z(), 0);
  const Vec3<double> out = RefractedOut(wo, normals, 1 / 1.5).direction(up); // below the critical angle of 41.8 degrees
  EXPECT_NEAR(std::hypot(out.x(), out.y()), 1.5 * std::sin(40 * pi<double> / 180), 1e-15);
  EXPECT_GT(RefractedOut(at<double>(43), normals, 1 / 1.5).direction(up).z(), 0);
}

TEST(HalfVector, RefusesNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BeckmannNormals<double> normals(0.1);
  EXPECT_THROW(Reflected(Vec3<double>(0, 0, 2), normals), Error);
  EXPECT_THROW(Reflected(Vec3<double>(0, nan, 1), normals), Error);
  for (const double eta : {0.0, -1.5, 1.0, 1e5, nan}) {
    EXPECT_THROW(RefractedIn(Vec3<double>(0, 0, 1), normals, eta), Error);
    EXPECT_THROW(RefractedOut(Vec3<double>(0, 0, 1), normals, eta), Error);
  }
  EXPECT_THROW(RefractedIn(Vec3<double>(0, 0, 1), normals, 0.9), Error);
  EXPECT_THROW(RefractedOut(Vec3<double>(0, 0, 1), normals, 1.1), Error);
}

} // namespace
} // namespace mc
