#include <render/film/film.h>

#include <mc/core/error.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Film, MeansAndVariancesOfTheMean) {
  Film film(2, 1);
  for (const double x : {1.0, 3.0})
    for (int px = 0; px < 2; ++px) film.add(px, 0, Eigen::Array3d(x, 2 * x, 5));
  const Image image = film.image();
  ASSERT_EQ(image.variance.size(), 2u);
  for (int px = 0; px < 2; ++px) {
    EXPECT_TRUE((image.at(px, 0) == Spectrum(2, 4, 5)).all());
    // Sample variance 2, 8 and 0; of the mean of two, half of it.
    EXPECT_NEAR(image.variance[image.index(px, 0)][0], 1, 1e-6);
    EXPECT_NEAR(image.variance[image.index(px, 0)][1], 4, 1e-6);
    EXPECT_EQ(image.variance[image.index(px, 0)][2], 0);
  }
  EXPECT_NEAR(film.relative_error(), std::sqrt(5 / 3.0) / (11 / 3.0), 1e-12);
}

TEST(Film, OneEstimateHasNoVariance) {
  Film film(1, 1);
  film.add(0, 0, Eigen::Array3d::Ones());
  EXPECT_TRUE(film.image().variance.empty());
  EXPECT_EQ(film.relative_error(), mc::infinity<double>);
}

TEST(Film, TellsWhichPixelsOneSampleDecides) {
  Film film(4, 1);
  const auto note = [&](int x, const std::vector<double>& luminances) {
    for (const double y : luminances) { // merging says the same as adding
      SampleSums one;
      one.add(y);
      film.note(x, 0, one);
    }
  };
  note(0, {1, 1, 1, 1, 1, 1, 1, 100});
  note(1, {1, 2, 3, 4, 5, 6, 7, 8});
  note(2, {0.1, 0.1, 0.1, 0.1});
  note(3, {0, 0, 0, 1, 1, 1});
  EXPECT_EQ(film.undecided(), 0.25);
}

TEST(Film, NeedsAPixel) {
  EXPECT_THROW(Film(0, 4), mc::Error);
  EXPECT_THROW(Film(4, -1), mc::Error);
}

} // namespace
