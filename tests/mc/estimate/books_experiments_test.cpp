// Numeric experiments from books on Monte Carlo and rendering, each compared with its analytic value. Comments mark
// values that differ from the printed ones. `carlo converge` shows the convergence of some of them.

#include <mc/core/error.h>
#include <mc/domain/box.h>
#include <mc/domain/hemisphere.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/linear.h>
#include <mc/warp/power.h>
#include <mc/warp/sphere.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/tent.h>
#include <mc/warp/trowbridge_reitz.h>

#include <gtest/gtest.h>

namespace {

using Unit = std::span<const double>;
using V = mc::Vec3<double>;
constexpr double pi = std::numbers::pi;

mc::Vec2<double> pair(Unit u) { return {u[0], u[1]}; }

// Checks mean and variance per sample of f(u) within rounding or 5 standard errors of 24 replicates, a false alarm in
// 5e-5 of seeds.
void expect_moments(const char* what, int dim, const std::function<double(Unit)>& f, double mean,
                    double variance = NAN) {
  mc::IntegrateOptions o;
  o.method = mc::Method::rqmc;
  o.rel_error = 0;
  o.max_calls = 200'000;
  const mc::VectorIntegrand both = [&](Unit u, std::span<double> y) {
    y[0] = f(u);
    y[1] = mc::sqr(y[0] - mean);
  };
  const mc::VectorIntegral r = mc::integrate_unit(both, 2, dim, o);
  EXPECT_LE(std::abs(r.outputs[0].estimate.value - mean),
            5 * r.outputs[0].estimate.std_error + 1e-11 * std::max(1.0, std::abs(mean)))
      << what;
  EXPECT_LE(r.outputs[0].estimate.std_error,
            2e-3 * std::max({1.0, std::abs(mean), std::isnan(variance) ? 0 : std::sqrt(variance)}))
      << what;
  if (!std::isnan(variance)) {
    EXPECT_LE(std::abs(r.outputs[1].estimate.value - variance),
              5 * r.outputs[1].estimate.std_error + 1e-11 * std::max(1.0, variance))
        << what;
  }
}

TEST(BooksExperiments, PiByDarts) {
  const auto hit = [](Unit u) { return mc::sqr(2 * u[0] - 1) + mc::sqr(2 * u[1] - 1) <= 1 ? 4.0 : 0.0; };
  expect_moments("pi", 2, hit, pi, pi * (4 - pi));
  expect_moments(
      "ball in cube", 3,
      [](Unit u) { return mc::sqr(2 * u[0] - 1) + mc::sqr(2 * u[1] - 1) + mc::sqr(2 * u[2] - 1) <= 1 ? 1.0 : 0.0; },
      pi / 6);
}

// pi by N jittered strata has the RMS error 2.85 N^-0.75. The RMS of 64 values has a standard error of 9 %; the bound
// is 3 of these.
TEST(BooksExperiments, PiByStrata) {
  for (const std::uint32_t side : {32u, 100u}) {
    double squares = 0;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
      mc::Pcg random(seed);
      int hits = 0;
      for (std::uint32_t i = 0; i < side; ++i)
        for (std::uint32_t j = 0; j < side; ++j)
          hits += mc::sqr(2 * (i + random.uniform<double>()) / side - 1) +
                      mc::sqr(2 * (j + random.uniform<double>()) / side - 1) <=
                  1;
      squares += mc::sqr(4.0 * hits / (side * side) - pi) / 64;
    }
    EXPECT_NEAR(std::sqrt(squares) / (2.85 * std::pow(side, -1.5)), 1, 0.3) << side;
  }
}

TEST(BooksExperiments, SquareByThreeDensities) {
  expect_moments(
      "density 1/2", 1, [](Unit u) { return 2 * mc::sqr(2 * u[0]); }, 8.0 / 3, 256.0 / 45);
  const mc::Linear<double> linear(0, 1); // x/2 on [0,2], in units of 2
  expect_moments(
      "density x/2", 1, [&](Unit u) { return 2 * mc::sqr(2 * linear.sample(u[0])) / linear.pdf(linear.sample(u[0])); },
      8.0 / 3, 8.0 / 9);
  const mc::Power<double> square(2); // 3 x^2 / 8
  expect_moments(
      "density 3 x^2 / 8", 1,
      [&](Unit u) { return 2 * mc::sqr(2 * square.sample(u[0])) / square.pdf(square.sample(u[0])); }, 8.0 / 3, 0);
  EXPECT_NEAR(linear.invert(0.5), 0.25, 1e-15);    // P(1) = 0.25
  EXPECT_NEAR(linear.invert(0.25), 0.0625, 1e-15); // P(0.5) = 0.0625
  EXPECT_NEAR(2 * linear.sample(0.49), 2 * std::sqrt(0.49), 1e-15);
  expect_moments(
      "E x of x/2", 1, [&](Unit u) { return 2 * linear.sample(u[0]); }, 4.0 / 3);
  expect_moments(
      "E x of 3 x^2 / 8", 1, [&](Unit u) { return 2 * square.sample(u[0]); }, 1.5);
}

// An integrable singularity at each multiple of pi.
TEST(BooksExperiments, LogarithmOfTheSine) {
  for (const auto& [hi, value] :
       {std::pair{pi, -2.177586090304}, {pi / 2, -1.088793045152}, {1.0, -1.056720205992}, {2.0, -1.102222388905}})
    expect_moments(
        "log sin", 1, [hi = hi](Unit u) { return hi * std::log(std::sin(hi * (1 - u[0]))); }, value);
}

TEST(BooksExperiments, CosinesOverSphereAndHemisphere) {
  const mc::UniformSphere<double> sphere;
  const mc::UniformHemisphere<double> uniform;
  const mc::CosineHemisphere<double> cosine;
  const auto cube = [](const V& w) { return w.z() * w.z() * w.z(); };
  // One book states 8 pi / 3.
  expect_moments(
      "cos^2 over the sphere", 2, [&](Unit u) { return mc::sqr(sphere.sample(pair(u)).z()) * 4 * pi; }, 4 * pi / 3,
      mc::sqr(3.746567856555));
  expect_moments(
      "cos over the hemisphere", 2, [&](Unit u) { return uniform.sample(pair(u)).z() * 2 * pi; }, pi);
  expect_moments(
      "cos^3, uniform", 2, [&](Unit u) { return cube(uniform.sample(pair(u))) * 2 * pi; }, pi / 2,
      4 * pi * pi / 7 - pi * pi / 4);
  expect_moments(
      "cos^3, cosine", 2, [&](Unit u) { return cube(cosine.sample(pair(u))) / cosine.pdf(cosine.sample(pair(u))); },
      pi / 2, pi * pi / 12);
  expect_moments(
      "E cos of the cosine lobe", 2, [&](Unit u) { return cosine.sample(pair(u)).z(); }, 2.0 / 3);
  EXPECT_NEAR(1 / sphere.pdf({0, 0, 1}), 4 * pi, 1e-14);
  EXPECT_NEAR(1 / uniform.pdf({0, 0, 1}), 2 * pi, 1e-14);
}

// exp(-x / 2 pi) sin^2 x on [0, 2 pi]. The book prints values with the noise of 1e4 samples: 1.977, 0.3147 and 2.016.
TEST(BooksExperiments, Halfway) {
  const auto f = [](double x) { return std::exp(-x / (2 * pi)) * mc::sqr(std::sin(x)); };
  expect_moments(
      "area", 1, [&](Unit u) { return 2 * pi * f(2 * pi * u[0]); }, 1.973368799888, mc::sqr(1.519486450210));
  expect_moments(
      "average", 1, [&](Unit u) { return f(2 * pi * u[0]); }, 0.314071399046);
  const auto table = mc::TableDist1D<double>::from_function(f, 4096, {0, 2 * pi});
  EXPECT_NEAR(table.sample(0.5), 2.038431863707, 1e-6);
}

TEST(BooksExperiments, RegularGridsAgainstChance) {
  expect_moments(
      "x^2 on [1,2]", 1, [](Unit u) { return mc::sqr(1 + u[0]); }, 7.0 / 3, mc::sqr(0.869226987360));
  double midpoint = 0, blind = 0;
  for (int i = 0; i < 100; ++i) {
    midpoint += mc::sqr(1 + (i + 0.5) / 100) / 100;
    blind += -std::cos(2 * pi * (i + 0.5));
  }
  EXPECT_NEAR(midpoint, 2.333325, 1e-12);
  EXPECT_NEAR(blind, 100, 1e-9); // the integral of -cos(2 pi x) over [0,100] is 0
  expect_moments(
      "cosine of a hundred periods", 1, [](Unit u) { return -100 * std::cos(200 * pi * u[0]); }, 0, 5000);
}

TEST(BooksExperiments, SolidAngles) {
  const V z(0, 0, 1);
  const auto seen = [&](double sin2) { return 1 / mc::UniformCone<double>::from_sin2(sin2).pdf(z); };
  EXPECT_NEAR(seen(0.25), 0.841787214477, 1e-12);
  EXPECT_NEAR(seen(1), 2 * pi, 1e-14);
  EXPECT_NEAR(seen(1e-20) / (pi * 1e-20), 1, 1e-15);
  // Light of the Cornell box from the middle of its floor: 130 x 105 at a height of 554.
  const mc::SphericalRectangle<double> light({213 - 278, 554, 227 - 279.5}, {130, 0, 0}, {0, 0, 105});
  EXPECT_NEAR(light.solid_angle(), 0.043975585816, 1e-12);
  expect_moments(
      "form factor", 2, [&](Unit u) { return light.sample(pair(u)).y() / pi * light.solid_angle(); }, 0.013945466356);
}

TEST(BooksExperiments, Moments) {
  for (const double h : {0.5, 2.0}) {
    const mc::Tent<double> tent(0, h);
    expect_moments(
        "variance of a tent", 1, [&](Unit u) { return mc::sqr(tent.sample(u[0])); }, h * h / 6);
  }
  // A radius proportional to u would give 1/3.
  expect_moments(
      "E r^2 of the disk", 2, [](Unit u) { return mc::UniformDisk<double>{}.sample(pair(u)).squaredNorm(); }, 0.5);
  for (const double alpha : {0.1, 1.0}) {
    const mc::TrowbridgeReitzNormals<double> normals(alpha);
    expect_moments(
        "normals project to 1", 2,
        [&](Unit u) {
          const double z = 1 - u[0];
          return 2 * pi * normals.pdf(mc::spherical_direction<double>(std::sqrt((1 - z) * (1 + z)), z, 2 * pi * u[1]));
        },
        1);
  }
}

// Energy of a solar cell over a day of 86000 s [J], for a power of 50 sin(pi t / 86000) + 2 [W].
TEST(BooksExperiments, Energy) {
  expect_moments(
      "energy", 1, [](Unit u) { return 86000 * (50 * std::sin(pi * u[0]) + 2); }, 8.6e6 / pi + 172000,
      mc::sqr(1323361.34816));
}

TEST(BooksExperiments, SymmetricDifferences) {
  const auto cube = [](double x) { return x * x * x; };
  const auto derivative = [&](double delta) { return (cube(2 + delta) - cube(2 - delta)) / (2 * delta); };
  EXPECT_NEAR(derivative(6e-6), 12, 1e-9);
  EXPECT_GT(std::abs(derivative(1e-10) - 12), 1e-7); // rounding dominates for a step that is too small
}

} // namespace
