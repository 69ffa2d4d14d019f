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
    film.add(px, 0, 1, Eigen::Array3d(3, 6, 5), 1); // the mean of all samples is 3, 6, 5
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
  EXPECT_NEAR(film.relative_errors().image.value, std::sqrt((0.75 / (2.5 * 2.5) + 3 / 25.0) / 3), 1e-12);
}

// Sets of different sizes: the weighted mean and its variance equal the values of all samples together. 20,000 pixels
// determine mean and variance within 1 %.
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

// Two sets of one sample each, and light paths for two samples per pixel: they add 3 to one set and 1 to the other.
TEST(Film, LightSplats_AddMeanAndVariance) {
  Film film(2, 1, 2, {.has_light_paths = true});
  for (int px = 0; px < 2; ++px) {
    film.add(px, 0, 0, grey(1), 1);
    film.add(px, 0, 1, grey(3), 1);
  }
  film.add_light_splat(0, 0, 0, grey(2));
  film.add_light_path_count(0, 1);
  film.add_light_splat(0, 0, 0, grey(1));
  film.add_light_splat(0, 0, 1, grey(1));
  film.add_light_path_count(1, 1);
  const PixelEstimate lit = film.estimate(0, 0), unlit = film.estimate(1, 0);
  EXPECT_NEAR(lit.mean[0], 2 + 2, 1e-12);
  EXPECT_NEAR(unlit.mean[0], 2, 1e-12);
  EXPECT_NEAR(unlit.variance[0], 1, 1e-12); // ((1 - 2)^2 + (3 - 2)^2) / 2
  EXPECT_EQ(unlit.light_variance[0], 0);
  EXPECT_NEAR(lit.light_variance[0], 1, 1e-12); // from the sums 3 and 1
  EXPECT_NEAR(lit.variance[0], 2, 1e-12);
}

// A single light path contribution dominates a pixel that is otherwise constant, in any unit of light. Many equal
// contributions do not.
TEST(Film, LightSplat_CanDominatePixel) {
  for (const double unit : {1e-30, 1.0, 1e30})
    for (const int paths : {1, 2, 100}) {
      Film film(1, 1, 2, {.has_light_paths = true});
      SampleSums samples;
      for (int i = 0; i < 64; ++i) samples.add(grey(unit * (i % 2 ? 1 : 1.1)));
      film.record_samples(0, 0, samples, 64);
      for (int set = 0; set < 2; ++set) {
        film.add(0, 0, set, grey(32 * unit), 32);
        film.add_light_path_count(set, 32);
      }
      for (int i = 0; i < paths; ++i) film.add_light_splat(0, 0, i % 2, grey(50 * unit));
      EXPECT_EQ(film.outlier_dominated(), paths == 1 ? 1 : 0) << paths << " " << unit;
    }
}

// 10x10 pixels of radiance 1 with an error of 5 %, and 100 light paths for each pixel.
Film lit_film() {
  Film film(10, 10, 2, {.has_light_paths = true});
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) {
      film.add(x, y, 0, grey(47.5), 50);
      film.add(x, y, 1, grey(52.5), 50);
      SampleSums samples;
      for (int i = 0; i < 100; ++i) samples.add(grey(i % 2 ? 0.5 : 1.5));
      film.record_samples(x, y, samples, 200);
    }
  for (int set = 0; set < 2; ++set) film.add_light_path_count(set, 50);
  return film;
}

// Light of the picture that came by one path to each of some pixels: the others have an unknown share of it.
TEST(Film, LightByOnePathToAPixel_ErrorIsUnknown) {
  for (const int paths : {1, 2}) {
    for (const double light : {40.0, 60.0, 400.0}) { // the sum over ten pixels; the other light has the sum 100
      Film film = lit_film();
      for (int x = 0; x < 10; ++x)
        for (int i = 0; i < paths; ++i) film.add_light_splat(x, 5, i, grey(100 * light / 10 / paths));
      EXPECT_EQ(std::isfinite(film.relative_errors().image.value), light < 100 || paths == 2) << light << " " << paths;
    }
  }
}

// No path reaches the film. Three, of 100 for each of 100 pixels, would add 3 v / 100 to the sum of the radiance, 100.
TEST(Film, LightByNoPath_IsPartOfTheError) {
  const RelativeErrors stated = lit_film().relative_errors();
  ASSERT_NEAR(stated.image.value, 0.05, 1e-9);
  for (const auto& [v, error] : {std::pair(50.0, 0.05), {500.0, 0.15}, {5000.0, mc::infinity<double>}}) {
    Film film = lit_film();
    film.add_unseen_light({.count = 4, .sum = 4 * v});
    const RelativeErrors errors = film.relative_errors();
    for (const RelativeError& e : {errors.image, errors.worst_block}) {
      EXPECT_DOUBLE_EQ(e.value, std::max(error, stated.image.value)) << v;
      EXPECT_GE(e.bound, e.value);
    }
    film.add_light_splat(3, 3, 0, grey(1));
    EXPECT_NEAR(film.relative_errors().image.value, stated.image.value, 0.01);
  }
}

TEST(Film, OneSetHasNoVariance) {
  Film film(1, 1, 2);
  film.add(0, 0, 0, grey(1), 5);
  EXPECT_TRUE(film.image().variance.empty());
  EXPECT_EQ(film.relative_errors().image.value, mc::infinity<double>);
}

// The relative error divides by the mean of the surroundings, and in dark regions by half of the image's mean.
TEST(Film, ErrorIsRelativeToTheSurroundings) {
  Film film(20, 20, 2);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const double radiance = y < 10 ? 0.0 : 4, off = x < 16 ? 0.0 : 0.5;
      film.add(x, y, 0, grey(radiance - off), 1);
      film.add(x, y, 1, grey(radiance + off), 1);
    }
  // The mean is 2. A fifth of the pixels have a variance of the mean of 0.25.
  double sum = 0;
  for (int y = 0; y < 20; ++y) {
    const double radiance = y < 9 ? 0.0 : y == 9 ? 4 / 3.0 : y == 10 ? 8 / 3.0 : 4;
    sum += 4 * 0.25 / mc::sqr(std::max(radiance, 1.0));
  }
  EXPECT_NEAR(film.relative_errors().image.value, std::sqrt(sum / 400), 1e-12);
  // The upper right block contains only pixels with noise, and the darkest of them.
  double worst = 0;
  for (int y = 0; y < 16; ++y) {
    const double radiance = y < 9 ? 0.0 : y == 9 ? 4 / 3.0 : y == 10 ? 8 / 3.0 : 4;
    worst += 4 * 0.25 / mc::sqr(std::max(radiance, 1.0)) / 64;
  }
  EXPECT_NEAR(film.relative_errors().worst_block.value, std::sqrt(worst), 1e-12);
}

// An edge crosses each pixel at a random place, and every set of 16 points counts a whole number of samples beyond it.
// The stated variance is at least the true variance on average, and at most a third larger.
TEST(Film, AgreeingSets_KeepVarianceOfEdge) {
  mc::Pcg random(5);
  double stated = 0, truth = 0;
  int held = 0, between = 0;
  constexpr int pixels = 20'000, points = 16, sets = 4;
  for (int i = 0; i < pixels; ++i) {
    Film film(1, 1, sets);
    const double covered = random.uniform<double>();
    SampleSums samples;
    double squares = 0;
    for (int set = 0; set < sets; ++set) {
      const double count = std::floor(covered * points + random.uniform<double>());
      for (int k = 0; k < points; ++k) samples.add(Eigen::Array3d(k < count, 0, 5));
      film.add(0, 0, set, Eigen::Array3d(count, 0, 5 * points), points);
      squares += mc::sqr(count / points - covered);
    }
    film.record_samples(0, 0, samples, 1);
    const PixelEstimate pixel = film.estimate(0, 0);
    stated += pixel.variance[0] / pixels;
    truth += squares / (sets * sets) / pixels;
    held += std::abs(pixel.mean[0] - covered) <= 3.182446 * std::sqrt(pixel.variance[0]);
    between += pixel.variance[0] > 0;
    EXPECT_EQ(pixel.variance[1], 0);
    EXPECT_EQ(pixel.variance[2], 0);
  }
  EXPECT_GE(stated, truth);
  EXPECT_LE(stated, 1.33 * truth);
  EXPECT_GE(double(held) / pixels, 0.95);
  EXPECT_GE(double(between) / pixels, 0.95); // the other pixels contain no edge
}

// If one pixel has all noise, four sets estimate its variance with 3 degrees of freedom. The bound then follows from
// chi-square with 3 degrees of freedom. The second bound is from 40 samples that are 2 off the mean. Their mean has the
// variance 4 / 39 with 40 degrees of freedom; the sets give 1 / 12.
TEST(Film, ErrorBoundCoversVarianceUncertainty) {
  Film one(8, 8, 4), all(8, 8, 4);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int set = 0; set < 4; ++set) {
        const double off = set % 2 == 0 ? 0.5 : -0.5;
        one.add(x, y, set, 10 * grey(x == 3 && y == 3 ? 2 + off : 2), 10);
        all.add(x, y, set, grey(2 + off), 1);
      }
  const RelativeError of_one = one.relative_errors().image, of_all = all.relative_errors().image;
  EXPECT_NEAR(of_one.bound / of_one.value, std::sqrt(3 / 0.351846), 1e-5); // tables of chi-square, 5 %
  // 5 * 64 - 2 degrees of freedom, since no pixel has an error of 0
  EXPECT_NEAR(of_all.bound / of_all.value, std::sqrt(318 / 277.687), 1e-5);
  for (int i = 0; i < 40; ++i) {
    SampleSums sample;
    sample.add(grey(i % 2 == 0 ? 0 : 4));
    one.record_samples(3, 3, sample, 1);
  }
  EXPECT_NEAR(one.relative_errors().image.bound / of_one.value, std::sqrt(4 / 39.0 * 12 * 40 / 26.5093), 1e-5);
  EXPECT_EQ(Film(1, 1, 2).relative_errors().image.bound, mc::infinity<double>);
}

// Samples have a Pareto distribution of index 3.5: most pictures lack the samples that carry much of the variance. The
// bound allows for them.
TEST(Film, ErrorBoundCoversBrighterSamples) {
  mc::Pcg random(7);
  constexpr int pictures = 100, side = 32, sets = 2, points = 16;
  constexpr double index = 3.5, mean = index / (index - 1);
  constexpr double variance = index / (mc::sqr(index - 1) * (index - 2));
  const double error = std::sqrt(variance / (sets * points)) / mean;
  int held = 0, below = 0;
  for (int picture = 0; picture < pictures; ++picture) {
    Film film(side, side, sets, {.independent_samples = true});
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        SampleSums samples;
        for (int set = 0; set < sets; ++set) {
          Eigen::Array3d sum = Eigen::Array3d::Zero();
          for (int i = 0; i < points; ++i) {
            const Eigen::Array3d sample = grey(std::pow(1 - random.uniform<double>(), -1 / index));
            samples.add(sample);
            sum += sample;
          }
          film.add(x, y, set, sum, points);
        }
        film.record_samples(x, y, samples, 1);
      }
    const RelativeError stated = film.relative_errors().image;
    held += stated.bound >= error;
    below += stated.value < error;
  }
  EXPECT_GE(held, 90); // 95 are promised
  EXPECT_GE(below, 60);
}

TEST(Film, CountsOutlierDominatedPixels) {
  Film film(4, 1, 1);
  const auto note = [&](int x, const std::vector<double>& luminances) {
    for (const double y : luminances) { // merging equals adding
      SampleSums one;
      one.add(grey(y));
      film.record_samples(x, 0, one, 3);
    }
  };
  note(0, {1, 1, 1, 1, 1, 1, 1, 100});
  note(1, {1, 2, 3, 4, 5, 6, 7, 8});
  note(2, {0.1, 0.1, 0.1, 0.1});
  note(3, {0, 0, 0, 1, 1, 1});
  EXPECT_EQ(film.outlier_dominated(), 0.25);
  EXPECT_EQ(film.rays(1, 0), 24u);
}

TEST(Film, NeedsAPixelAndASet) {
  EXPECT_THROW(Film(0, 4, 4), mc::Error);
  EXPECT_THROW(Film(4, -1, 4), mc::Error);
  EXPECT_THROW(Film(4, 4, 0), mc::Error);
}

} // namespace
