// Regression tests for defects that were observed in the warps of other renderers. Each comment states the defect. The
// laws of each warp test the bounds over whole ranges.

#include <mc/check/subject/oracle.h>
#include <mc/random/pcg.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/exponential.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/normal.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/tent.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <gtest/gtest.h>

#include <set>

namespace mc {
namespace {

constexpr float eps = std::numeric_limits<float>::epsilon();
const float last = one_minus_epsilon<float>;
using V = Vec3<float>;

V at(double degrees) {
  const double t = degrees * std::numbers::pi / 180;
  return V(static_cast<float>(std::sin(t)), 0, degrees == 90 ? 0.0f : static_cast<float>(std::cos(t)));
}

// pbrt-v4, Mitsuba 3: narrow cones have an infinite pdf and return only the axis; the error begins at angles of 1e-3
// rad.
TEST(PeerDefects, ConesDownTo1e9Radians) {
  for (const double angle : {1e-3, 2e-4, 1e-9}) {
    const auto cone = UniformCone<float>::from_angle(static_cast<float>(angle));
    EXPECT_NEAR(cone.pdf({0, 0, 1}) * pi<double> * angle * angle, 1, 1e-6);
    std::set<float> distinct;
    double widest = 0;
    for (int i = 0; i < 1000; ++i) {
      const V w = cone.sample({(static_cast<float>(i) + 0.5f) / 1000, 0.125f});
      distinct.insert(w.x());
      widest = std::max(widest, double(std::hypot(w.x(), w.y())));
      EXPECT_NEAR(cone.invert(w)[0], (static_cast<float>(i) + 0.5f) / 1000, 16 * eps);
    }
    EXPECT_EQ(distinct.size(), 1000u);
    EXPECT_NEAR(widest / angle, std::sqrt(0.9995), 1e-5);
  }
}

// pbrt-v4: a few cosine-distributed directions lie on the horizon, where the pdf is 0; one of them is u = (0, 1/2).
TEST(PeerDefects, CosineDirectionsNeverLieOnTheHorizon) {
  const CosineHemisphere<float> warp;
  for (int i = 0; i <= 4096; ++i)
    for (const float edge : {0.0f, 0x1p-24f, last}) {
      const float t = std::min(static_cast<float>(i) / 4096, last);
      for (const Vec2<float>& u : {Vec2<float>(edge, t), Vec2<float>(t, edge)})
        ASSERT_GT(warp.pdf(warp.sample(u)), 0) << u.transpose();
    }
}

// pbrt-v4: g is clamped to 0.99, so a lobe with g = 0.9999 has a far too low peak. |g| < 1e-3 is sampled uniformly.
TEST(PeerDefects, HenyeyGreensteinIsNeitherClampedNorRounded) {
  const HenyeyGreenstein<float> peaked = HenyeyGreenstein<float>::from_one_minus_abs_g(1e-4f), faint(0.00099f);
  EXPECT_NEAR(peaked.pdf({0, 0, 1}) / (1.9999 / (4 * pi<double> * 1e-8)), 1, 16 * eps);
  double mean_peaked = 0, mean_faint = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Vec2<float> u((static_cast<float>(i) + 0.5f) / 100'000, 0);
    mean_peaked += one_minus_z(peaked.sample(u)) / 1e5;
    mean_faint += faint.sample(u).z() / 1e5;
  }
  EXPECT_NEAR(mean_peaked, 1e-4, 1e-6); // mean of 1 - cos
  EXPECT_NEAR(mean_faint, 0.00099, 1e-6);
}

// Mitsuba 3: kappa = 1e-9 gives an infinite pdf and a single direction. kappa = 1e8 integrates to 3 and gives three
// different cosines.
TEST(PeerDefects, VonMisesFisherFromUniformToNeedle) {
  for (const float kappa : {1e-9f, 1e-7f, 1e-4f, 1.0f, 1e6f, 1e8f}) {
    const VonMisesFisher<float> warp(kappa);
    std::set<float> distinct;
    double mean = 0; // mean of 1 - cos; the exact value is 1 - coth(kappa) + 1 / kappa
    for (int i = 0; i < 10'000; ++i) {
      const V w = warp.sample({(static_cast<float>(i) + 0.5f) / 10'000, 0.1f});
      distinct.insert(w.x());
      mean += one_minus_z(w) / 1e4;
    }
    const double k = kappa, truth = k < 1e-3 ? 1 - k / 3 : 1 - 1 / std::tanh(k) + 1 / k;
    EXPECT_NEAR(mean / truth, 1, 1e-3) << kappa;
    EXPECT_GE(distinct.size(), 4900u) << kappa; // each x = sin occurs twice, once on either side of the equator
    EXPECT_NEAR(warp.pdf({0, 0, 1}) * 2 * pi<double> * (k < 1e-3 ? 2 : (1 - std::exp(-2 * k)) / k), 1, 1e-4) << kappa;
  }
}

// pbrt-v4: the pdf of small spherical triangles and rectangles is far off, and some samples have none. The expected
// solid angle is area / distance^2, exact to second order.
TEST(PeerDefects, SphericalTrianglesAndRectanglesOf1e8Steradians) {
  for (const double edge : {1e-3, 1e-4}) {
    const auto e = static_cast<float>(edge);
    for (const float aspect : {1.0f, 0.02f}) {
      const SphericalTriangle<float> triangle({0, 0, 1}, {e, 0, 0}, {0, e * aspect, 0});
      const SphericalRectangle<float> rectangle({0, 0, 1}, {e, 0, 0}, {0, e * aspect, 0});
      const double area = double(e) * double(e * aspect);
      Pcg random(1);
      for (int i = 0; i < 1000; ++i) {
        const Vec2<float> u = random.point<float, 2>();
        EXPECT_NEAR(triangle.pdf(triangle.sample(u)) * area / 2, 1, 3e-6) << edge << ' ' << aspect;
        EXPECT_NEAR(rectangle.pdf(rectangle.sample(u)) * area, 1, 3e-6) << edge << ' ' << aspect;
      }
    }
  }
}

// pbrt-v4: at small roughness some visible normals have an inaccurate pdf. At grazing incidence and alpha = 1 some have
// pdf 0, and on the horizon the pdf is infinite.
TEST(PeerDefects, VisibleNormalsAtSmallRoughnessAndOnTheHorizon) {
  for (const float alpha : {1e-3f, 1.0f})
    for (const double degrees : {0.0, 45.0, 89.99, 90.0}) {
      const TrowbridgeReitzVisibleNormals<float> warp(at(degrees), alpha);
      const auto exact = warp.cast<Oracle>();
      Pcg random(2);
      for (int i = 0; i < 500; ++i) {
        const V m = warp.sample(random.point<float, 2>());
        EXPECT_NEAR(double(Oracle(warp.pdf(m) / exact.pdf(cast_point<Oracle>(m)))), 1, 16 * eps)
            << alpha << ' ' << degrees;
      }
    }
}

// pbrt-v4: a frame that is not orthogonal near the pole biases the mean of atan(slope / alpha). To first order the mean
// is alpha tan(theta); the bias at alpha = 0.01 and 24 degrees is a third of it.
TEST(PeerDefects, VisibleNormalsNearThePoleAreNotSkewed) {
  const double t = 24 * std::numbers::pi / 180;
  const TrowbridgeReitzVisibleNormals<double> warp({std::sin(t), 0, std::cos(t)}, 0.01);
  double mean = 0;
  constexpr int n = 500; // strata of u; the error of the midpoint rule is below 1e-4
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3<double> m = warp.sample({(i + 0.5) / n, (j + 0.5) / n});
      mean += std::atan(m.x() / m.z() / 0.01) / (double(n) * n);
    }
  EXPECT_NEAR(mean, 0.01 * std::tan(t), 1e-4);
}

// Mitsuba 3: Beckmann normals are NaN at u = (1/2, 1/2). Along the edges of the unit square they lie on the horizon
// with pdf 0.
TEST(PeerDefects, BeckmannAtTheMiddleAndTheEdges) {
  const BeckmannNormals<float> warp(0.3f);
  for (const float a : {0.0f, 0.25f, 0.5f, 0.75f, last})
    for (const float b : {0.0f, 0.3f, 0.5f, last}) EXPECT_GT(warp.pdf(warp.sample({a, b})), 0) << a << ' ' << b;
  const Vec2<float> u = warp.invert({0, 0, 1});
  EXPECT_TRUE(std::isfinite(u[0]) && std::isfinite(u[1]));
}

// Mitsuba 3: points of the concentric disk with |p| > 1 have pdf 0. Here |p| exceeds 1 by rounding only, and such
// points belong to the disk.
TEST(PeerDefects, ConcentricDiskKeepsItsRim) {
  for (int i = 0; i < 65536; ++i) {
    const Vec2<float> p = UniformDisk<float>{}.sample({0, static_cast<float>(i) / 65536});
    ASSERT_GT(UniformDisk<float>{}.pdf(p), 0);
    ASSERT_LE(p.squaredNorm(), 1 + 4 * eps);
  }
}

// pbrt-v4, Mitsuba 3: a zero edge gives NaN at u1 = 0. Weights of 1e30 give NaN or a corner, weights of 1e-25 give
// points outside, and nearly equal weights are inaccurate.
TEST(PeerDefects, BilinearWithZeroEdgesAndExtremeWeights) {
  const auto expect_good = [](const Bilinear<float>& warp, const Vec2<float>& u) {
    const Vec2<float> p = warp.sample(u), back = warp.invert(p);
    EXPECT_TRUE(warp.domain().contains(p)) << p.transpose();
    EXPECT_GT(warp.pdf(p), 0) << p.transpose();
    EXPECT_LE((back - u).norm(), 32 * eps) << p.transpose();
  };
  expect_good(Bilinear<float>(0, 0, 1, 1), {0.3f, 0});
  expect_good(Bilinear<float>(1e30f, 1e30f, 2e30f, 3e30f), {0.3f, 0.4f});
  expect_good(Bilinear<float>(1e-25f, 2e-25f, 1e-25f, 3e-25f), {0.3f, 0.4f});
  for (const float w : {1.0001f, 1.0003f}) expect_good(Bilinear<float>(1, w, 1, w), {0.3f, 0.4f});
  EXPECT_THROW(Bilinear<float>(0, 0, 0, 0), Error); // NaN in other renderers
  EXPECT_THROW(Linear<float>(0, 0), Error);
}

// pbrt-v4: the trimmed exponential returns few distinct numbers at small rates. At rate 0 it is NaN instead of uniform.
TEST(PeerDefects, TrimmedExponentialOfAnyRate) {
  for (const float rate : {0.0f, 1e-8f, 1e-6f, 1e-3f, 1.0f}) {
    const TrimmedExponential<float> warp(rate, 1);
    std::set<float> distinct;
    for (int i = 0; i < 1000; ++i) distinct.insert(warp.sample(static_cast<float>(i) / 1000));
    EXPECT_GE(distinct.size(), 999u) << rate;
    const double c = rate, truth = c == 0 ? 1 : c * std::exp(-c / 2) / -std::expm1(-c);
    EXPECT_NEAR(warp.pdf(0.5f), truth, 8 * eps) << rate;
  }
}

// Infinities, NaN and an extreme normal deviate occur in other renderers at u = 0 and 1 - ulp.
TEST(PeerDefects, EndsOfTheUnitInterval) {
  for (const float u : {0.0f, 0.5f, last}) {
    const auto finite = [&](const char* name, const auto& warp) {
      const float x = warp.sample(u);
      EXPECT_TRUE(std::isfinite(x) && warp.pdf(x) > 0) << name << " at " << u << ": " << x << ", pdf " << warp.pdf(x);
    };
    finite("Exponential", Exponential<float>(1));
    finite("Logistic", Logistic<float>(0, 1));
    finite("TrimmedLogistic", TrimmedLogistic<float>(1, -2, 3));
    finite("Normal", Normal<float>(0, 1));
    finite("Linear", Linear<float>(0, 1));
    finite("Linear down", Linear<float>(1, 0));
    finite("Smoothstep", Smoothstep<float>());
    finite("Tent", Tent<float>(0, 1));
    EXPECT_LE(std::abs(Normal<float>(0, 1).sample(u)), 14);
  }
}

// pbrt-v4 before 2025: the Box-Muller pair is NaN for most u. Later versions are infinite at u = 1 and -0 at u = 0.
TEST(PeerDefects, IsotropicNormalEverywhere) {
  for (const float a : {0.0f, 0x1p-24f, 0.5f, last})
    for (const float b : {0.0f, 0.25f, 0.5f, last}) {
      const Vec2<float> x = IsotropicNormal<float>{}.sample({a, b});
      EXPECT_TRUE(x.allFinite() && IsotropicNormal<float>{}.pdf(x) > 0) << a << ' ' << b;
    }
}

// Mitsuba 3: inverses at the pole are NaN.
TEST(PeerDefects, InversesAtThePoleAreNumbers) {
  const V pole(0, 0, 1);
  const auto good = [](const Vec2<float>& u) { return u[0] >= 0 && u[0] < 1 && u[1] >= 0 && u[1] < 1; };
  EXPECT_TRUE(good(UniformCone<float>::from_angle(0.1f).invert(pole)));
  EXPECT_TRUE(good(CosineHemisphere<float>{}.invert(pole)));
  EXPECT_TRUE(good(VonMisesFisher<float>(0).invert(pole)));
  EXPECT_TRUE(good(VonMisesFisher<float>(10).invert(pole)));
  EXPECT_TRUE(good(HenyeyGreenstein<float>(0.5f).invert(pole)));
  EXPECT_TRUE(good(TrowbridgeReitzNormals<float>(0.1f).invert(pole)));
  EXPECT_TRUE(good(TrowbridgeReitzVisibleNormals<float>(pole, 0.1f).invert(pole)));
}

} // namespace
} // namespace mc
