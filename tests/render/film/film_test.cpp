#include <render/film/film.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Eigen::Array3d grey(double x) { return Eigen::Array3d::Constant(x); }

TEST(Film, MeansAndVariancesOfTheMean) {
  Film film(2, 1, 2);
  for (int px = 0; px < 2; ++px) {
    film.add(px, 0, 0, Eigen::Array3d(1, 2, 5), 1);
    film.add(px, 0, 1, Eigen::Array3d(6, 12, 10), 2);
    film.add(px, 0, 1, Eigen::Array3d(3, 6, 5), 1); // in all a mean of 3, 6, 5
  }
  const Image image = film.image();
  ASSERT_EQ(image.variance.size(), 2u);
  for (int px = 0; px < 2; ++px) {
    EXPECT_TRUE((image.at(px, 0) == Spectrum(2.5, 5, 5)).all());
    // (1 * 1.5^2 + 3 * 0.5^2) / 4
    EXPECT_NEAR(image.variance[image.index(px, 0)][0], 0.75, 1e-6);
    EXPECT_NEAR(image.variance[image.index(px, 0)][1], 3, 1e-6);
    EXPECT_EQ(image.variance[image.index(px, 0)][2], 0);
    EXPECT_EQ(film.estimate(px, 0).samples, 4u);
    EXPECT_EQ(film.estimate(px, 0).sets, 2);
  }
  EXPECT_NEAR(film.relative_error(), std::sqrt((0.75 / (2.5 * 2.5) + 3 / 25.0) / 3), 1e-12);
}

// Sets of any sizes: their weighted mean and its variance are those of all samples together. 20,000 pixels, whose mean
// and variance are known to 1 %.
TEST(Film, SetsOfUnequalSizesAreUnbiased) {
  mc::Pcg random(3);
  mc::Moments means;
  double variance = 0;
  constexpr int pixels = 20'000;
  for (int i = 0; i < pixels; ++i) {
    Film film(1, 1, 4);
    const int sizes[] = {1, 7, 2, 3};
    for (int set = 0; set < 4; ++set)
      for (int k = 0; k < sizes[set]; ++k) film.add(0, 0, set, grey(random.uniform<double>()), 1);
    const PixelEstimate pixel = film.estimate(0, 0);
    means.add(pixel.mean[0]);
    variance += pixel.variance[0] / pixels;
  }
  EXPECT_NEAR(means.mean(), 0.5, 4 * means.std_error());
  EXPECT_NEAR(means.variance(), 1 / 12.0 / 13, 0.04 / 12 / 13); // four times sqrt(2 / pixels)
  EXPECT_NEAR(variance, 1 / 12.0 / 13, 0.03 / 12 / 13);         // four times sqrt(2 / 3 / pixels)
}

TEST(Film, OneSetHasNoVariance) {
  Film film(1, 1, 2);
  film.add(0, 0, 0, grey(1), 5);
  EXPECT_TRUE(film.image().variance.empty());
  EXPECT_EQ(film.relative_error(), mc::infinity<double>);
}

// What it says is what the pixels of its image are off by: dark ones relative to half the mean, bright ones to their
// surroundings.
TEST(Film, ErrorIsRelativeToTheSurroundings) {
  Film film(20, 20, 2);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const double radiance = y < 10 ? 0.0 : 4, off = x < 16 ? 0.0 : 0.5;
      film.add(x, y, 0, grey(radiance - off), 1);
      film.add(x, y, 1, grey(radiance + off), 1);
    }
  // Mean 2; variance of the mean 0.25 in a fifth of the pixels.
  double sum = 0;
  for (int y = 0; y < 20; ++y) {
    const double radiance = y < 9 ? 0.0 : y == 9 ? 4 / 3.0 : y == 10 ? 8 / 3.0 : 4;
    sum += 4 * 0.25 / mc::sqr(std::max(radiance, 1.0));
  }
  EXPECT_NEAR(film.relative_error(), std::sqrt(sum / 400), 1e-12);
  // Of the blocks, 16x16 from the corner, the upper right one holds only such pixels, the darkest.
  double worst = 0;
  for (int y = 0; y < 16; ++y) {
    const double radiance = y < 9 ? 0.0 : y == 9 ? 4 / 3.0 : y == 10 ? 8 / 3.0 : 4;
    worst += 4 * 0.25 / mc::sqr(std::max(radiance, 1.0)) / 64;
  }
  EXPECT_NEAR(film.relative_error(ErrorOf::worst), std::sqrt(worst), 1e-12);
}

TEST(Film, TellsWhichPixelsOneSampleDecides) {
  Film film(4, 1, 1);
  const auto note = [&](int x, const std::vector<double>& luminances) {
    for (const double y : luminances) { // merging says the same as adding
      SampleSums one;
      one.add(y);
      film.note(x, 0, one, 3);
    }
  };
  note(0, {1, 1, 1, 1, 1, 1, 1, 100});
  note(1, {1, 2, 3, 4, 5, 6, 7, 8});
  note(2, {0.1, 0.1, 0.1, 0.1});
  note(3, {0, 0, 0, 1, 1, 1});
  EXPECT_EQ(film.undecided(), 0.25);
  EXPECT_EQ(film.rays(1, 0), 24u);
}

TEST(Film, NeedsAPixelAndASet) {
  EXPECT_THROW(Film(0, 4, 4), mc::Error);
  EXPECT_THROW(Film(4, -1, 4), mc::Error);
  EXPECT_THROW(Film(4, 4, 0), mc::Error);
}

} // namespace
