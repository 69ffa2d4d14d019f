#include <converge/picture_errors.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace carlo;

constexpr int side = 32;

render::Image grey(double value) {
  render::Image image(side, side);
  for (render::Spectrum& p : image.pixels) p.setConstant(render::Float(value));
  return image;
}

// Pictures of mean 1 + bias with uniform noise of this standard deviation in every pixel and channel.
PictureSeries series(double bias, double deviation, int count) {
  mc::Pcg random(7);
  PictureSeries s{4};
  for (int r = 0; r < count; ++r) {
    render::Image image = grey(1 + bias);
    for (render::Spectrum& p : image.pixels)
      for (int c = 0; c < 3; ++c) p[c] += render::Float(deviation * std::sqrt(12.0) * (random.uniform<double>() - 0.5));
    image.variance.assign(image.pixels.size(), render::Spectrum::Constant(render::Float(deviation * deviation)));
    s.images.push_back(std::move(image));
    s.replicates.seconds.push_back(2);
  }
  return s;
}

// Without a floor, relmse is the square of the error relative to the reference of 1.
const ReferencePicture reference{grey(1), 1000, 0, 0};

TEST(PictureErrors, Floor_IsATenthOfTheSquaredMean) { EXPECT_NEAR(relmse_floor_of(grey(3)), 0.9, 1e-6); }

TEST(PictureErrors, ErrorOfNoise_IsItsDeviation) {
  render::Image even = grey(2);
  even.variance.assign(even.pixels.size(), render::Spectrum::Constant(0.04f));
  EXPECT_NEAR(noise(even, {grey(2), 1000, 0, 0}), 0.01, 1e-6) << "the variance over the squared reference";
  const PictureSeries s = series(0, 0.1, 16);
  const mc::RmsError e = error_of(s, reference);
  EXPECT_NEAR(e.rms, 0.1, 2e-3);
  EXPECT_LE(e.lo, e.rms);
  EXPECT_GE(e.hi, e.rms);
  EXPECT_EQ(e.seconds, 2);
  EXPECT_FALSE(e.is_bound);
  EXPECT_EQ(pictures_needed(s, reference), first_pictures) << "the mean of 1024 pixels hardly varies";
}

// The noise of a picture and of the reference are told from the bias.
TEST(PictureErrors, Bias_IsToldFromNoise) {
  const WorkAndBias biased = bias_of(series(0.02, 0.1, 16), reference, 1),
                    right = bias_of(series(0, 0.1, 16), reference, 1);
  EXPECT_LE(biased.bias.bias.lo, 0.02);
  EXPECT_GE(biased.bias.bias.hi, 0.02);
  EXPECT_GT(biased.bias.bias.lo, 0.01);
  EXPECT_EQ(right.bias.bias.lo, 0);
  EXPECT_NEAR(right.work, 2 * 0.01, 5e-4) << "seconds times relmse of the noise";
}

// A biased method of a quarter of the work takes as long as the unbiased one where e^2 - bias^2 = e^2 / 4.
TEST(PictureErrors, BreakEven_SolvesForTheError) {
  std::vector<WorkAndBias> all(2);
  all[0].work = 4;
  all[1].work = 1;
  all[1].bias.bias = {0.03, 0.02, 0.04};
  set_break_even_errors(all);
  ASSERT_TRUE(all[1].bias.break_even_error);
  EXPECT_NEAR(all[1].bias.break_even_error->value, 0.03 / std::sqrt(0.75), 1e-12);
  EXPECT_FALSE(all[0].bias.break_even_error);
}

TEST(PictureErrors, Fit_FindsTheSlope) {
  ConvergenceCurve curve;
  for (const double n : {4.0, 8.0, 16.0, 32.0}) {
    const double e = 1 / std::sqrt(n);
    curve.errors.push_back({n, e, 0.9 * e, 1.1 * e, 1});
  }
  fit(curve);
  ASSERT_TRUE(curve.power_law);
  EXPECT_NEAR(curve.power_law->slope, -0.5, 1e-9);
  EXPECT_NEAR(curve.fit_center, std::sqrt(128.0), 1e-9);
}

} // namespace
