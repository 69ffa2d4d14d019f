#include <render/light/environment.h>

#include <mc/random/pcg.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

std::shared_ptr<const Texels> picture(int width, int height, const std::function<Spectrum(int, int)>& f) {
  std::vector<Spectrum> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values.push_back(f(x, y));
  return std::make_shared<const Texels>(width, height, std::move(values));
}

TEST(Environment, MatchesMitsubaOrientation) {
  // Four columns are at -z, +x, +z and -x; the top row is at +y.
  const Environment e(picture(4, 2, [](int x, int y) { return Spectrum(Float(x + 1), Float(y), 0); }));
  const auto red = [&](const Vec3d& d) { return e.Le(d.normalized().cast<Float>(), nullptr)[0]; };
  const double between = mc::pi<double> / 4; // the middle of a column
  EXPECT_NEAR(red({std::sin(between), 0, -std::cos(between)}), 1, 1e-5);
  EXPECT_NEAR(red({std::cos(between), 0, std::sin(between)}), 2, 1e-5);
  EXPECT_NEAR(red({-std::sin(between), 0, std::cos(between)}), 3, 1e-5);
  EXPECT_NEAR(red({-std::cos(between), 0, -std::sin(between)}), 4, 1e-5);
  EXPECT_NEAR(red({0, 0, -1}), 2.5, 1e-5) << "the seam";
  EXPECT_EQ(e.Le(Vec3::UnitY(), nullptr)[1], 0);
  EXPECT_EQ(e.Le(-Vec3::UnitY(), nullptr)[1], 1);
  const SurfacePoint met;
  EXPECT_TRUE(is_black(e.Le(Vec3::UnitX(), &met)));
}

TEST(Environment, TurnsWithItsTransform) {
  const auto sun =
      picture(8, 4, [](int x, int y) { return Spectrum::Constant(x == 1 && y == 1 ? Float(9) : Float(1)); });
  const Environment plain(sun), turned(sun, Transform::rotate({0, 1, 0}, 90), 2);
  mc::Pcg random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3d d =
        Vec3d(random.uniform<double>() - 0.5, random.uniform<double>() - 0.5, random.uniform<double>() - 0.5)
            .normalized();
    const Vec3d there = Transform::rotate({0, 1, 0}, 90).vector(d);
    EXPECT_NEAR(turned.Le(there.cast<Float>(), nullptr)[0], 2 * plain.Le(d.cast<Float>(), nullptr)[0], 1e-3);
  }
}

// Samples have the density pdf(). The mean of radiance over density is the flux, and the density integrates to 1.
// Regular grids that differ from the grid of texels evaluate both, on random images with black texels.
TEST(Environment, SampleAgreesWithPdf) {
  mc::Pcg random(4);
  for (int trial = 0; trial < 6; ++trial) {
    const int width = 1 + trial * 3, height = 1 + trial * 2;
    const auto texels = picture(width, height, [&](int x, int y) {
      const bool black = random.uniform<double>() < 0.4 && (x > 0 || y > 0);
      return Spectrum(Spectrum::Constant(black ? Float(0) : random.uniform<Float>() + Float(0.1)));
    });
    const Environment e(texels);
    double flux = 0, solid_angle = 0;
    constexpr int n = 300;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto s = e.sample(Vec3::Zero(), Vec2((Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n));
        ASSERT_TRUE(s);
        EXPECT_GT(s->pdf, 0);
        EXPECT_FALSE(s->point);
        flux += double(luminance(s->radiance)) / double(s->pdf) / (n * n);
        // Grid in (theta, phi) for the integral of the density, which is constant times 1 / sin(theta) in a texel.
        const double theta = mc::pi<double> * (i + 0.5) / n, phi = 2 * mc::pi<double> * (j + 0.5) / n,
                     r = std::sin(theta);
        const Vec3 wi = Vec3d(r * std::cos(phi), std::cos(theta), r * std::sin(phi)).cast<Float>();
        solid_angle += double(e.pdf(Vec3::Zero(), wi, nullptr)) * r * 2 * mc::sqr(mc::pi<double>) / (n * n);
      }
    EXPECT_NEAR(solid_angle, 1, 0.02) << width << "x" << height;
    EXPECT_NEAR(flux * mc::pi<double> / e.power(1), 1, 0.02) << width << "x" << height;
  }
}

TEST(Environment, RefusesNonsense) {
  const auto error = [](const std::shared_ptr<const Texels>& t, const Transform& m, double scale) {
    try {
      Environment(t, m, scale);
    } catch (const mc::Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto grey = picture(2, 2, [](int, int) { return Spectrum(Spectrum::Ones()); });
  EXPECT_THAT(error(picture(2, 2, [](int, int) { return Spectrum(Spectrum::Zero()); }), {}, 1),
              testing::HasSubstr("every texel is black"));
  EXPECT_THAT(
      error(picture(2, 2, [](int x, int) { return Spectrum(Spectrum::Constant(x ? Float(-1) : Float(1))); }), {}, 1),
      testing::HasSubstr("texel (1, 0) = (-1, -1, -1) must be finite and >= 0"));
  EXPECT_THAT(error(grey, Transform::scale({2, 2, 2}), 1), testing::HasSubstr("must be a rotation"));
  EXPECT_THAT(error(grey, {}, 0), testing::HasSubstr("scale 0 must be finite and > 0"));
}

} // namespace
