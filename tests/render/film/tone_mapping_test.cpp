#include <render/film/tone_mapping.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;

constexpr std::array<ToneCurve, 3> all = {ToneCurve::clamp, ToneCurve::reinhard, ToneCurve::filmic};

Spectrum gray(double x) { return Spectrum::Constant(Float(x)); }

// The curves are monotone; black stays black and white stays white.
TEST(ToneMapping, CurvesRiseFromBlackToWhite) {
  for (const ToneCurve curve : all) {
    EXPECT_TRUE((tone_map(gray(0), {curve}) == 0).all());
    double last = 0;
    for (double x = 1e-6; x < 1e30; x *= 1.1) {
      const double y = tone_map(gray(x), {curve})[1];
      EXPECT_GE(y, last - 1e-12) << x;
      EXPECT_LE(y, 1) << x;
      last = y;
    }
    EXPECT_NEAR(last, 1, 1e-9);
    EXPECT_TRUE((tone_map(Spectrum(-1, -1e30f, mc::infinity<Float>), {curve}).tail(1) >= 0).all());
    EXPECT_TRUE((tone_map(gray(-1), {curve}) == 0).all());
  }
}

TEST(ToneMapping, ReinhardKeepsTheColour) {
  mc::Pcg random(1);
  for (int i = 0; i < 100; ++i) {
    const Spectrum c(random.uniform<Float>(), random.uniform<Float>(), random.uniform<Float>());
    const Eigen::Array3d shown = tone_map(c, {ToneCurve::reinhard});
    const double y = double(luminance(c));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(shown[k], double(c[k]) / (1 + y), 1e-6);
  }
}

// Values of [Hable10]'s formula from its constants, in exact fractions: f(2 x) / f(11.2) with f(x) = (x (.15 x + .05) +
// .004) / (x (.15 x + .5) + .06) - 1 / 15.
TEST(ToneMapping, FilmicPoints) {
  EXPECT_NEAR(tone_map(gray(5.6), {ToneCurve::filmic})[0], 1, 1e-7);
  EXPECT_LT(tone_map(gray(5.5), {ToneCurve::filmic})[0], 1);
  const double f1 = 0.204 / 0.71 - 1.0 / 15, white = (11.2 * 1.73 + 0.004) / (11.2 * 2.18 + 0.06) - 1.0 / 15;
  EXPECT_NEAR(tone_map(gray(0.5), {ToneCurve::filmic})[2], f1 / white, 1e-12);
  EXPECT_NEAR(tone_map(gray(0.18), {ToneCurve::filmic})[2], 0.13, 0.005) << "as the header says";
}

TEST(ToneMapping, ExposureIsInStops) {
  for (const ToneCurve curve : all)
    EXPECT_NEAR(tone_map(gray(0.1), {curve, 1.5})[0], tone_map(gray(0.1 * std::exp2(1.5)), {curve})[0], 1e-6);
}

// The result does not depend on the unit of light, and black parts are ignored.
TEST(ToneMapping, AutoExposureFollowsTheScene) {
  mc::Pcg random(2);
  Image image(16, 16);
  for (Spectrum& p : image.pixels) p = gray(random.uniform<double>() + 0.01);
  const double stops = auto_exposure(image);
  for (const double gain : {1e-20, 1e-3, 1e3, 1e20}) {
    Image scaled = image;
    for (Spectrum& p : scaled.pixels) p *= Float(gain);
    EXPECT_NEAR(auto_exposure(scaled), stops - std::log2(gain), 1e-5);
  }
  for (std::size_t i = 0; i < 100; ++i) image.pixels[i] = gray(0.36);
  for (std::size_t i = 100; i < 256; ++i) image.pixels[i] = gray(0);
  EXPECT_NEAR(auto_exposure(image), -1, 1e-6);
  EXPECT_EQ(auto_exposure(Image(3, 3)), 0);
}

TEST(ToneMapping, Names) {
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(tone_curve_from(tone_curve_names[i]), all[i]);
  EXPECT_THAT(support::error_of([] { tone_curve_from("filmc"); }), testing::HasSubstr("did you mean 'filmic'"));
}

} // namespace
