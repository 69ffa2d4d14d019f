#include <render/film/sampling_plan.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace render;

// A film of radiance 1 with a relative standard error of `noise(x, y)` per sample and `rays(x, y)` rays per sample.
template <class Noise, class Rays> Film film_of(int width, int height, Noise&& noise, Rays&& rays) {
  Film film(width, height, 2);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (const int set : {0, 1})
        film.add(x, y, set, Eigen::Array3d::Constant(8 * (1 + (set - 0.5) * noise(x, y) / 2)), 8);
      film.record_samples(x, y, {}, 16 * std::uint64_t(rays(x, y)));
    }
  return film;
}

double mean(const std::vector<float>& rates) {
  return std::accumulate(rates.begin(), rates.end(), 0.0) / double(rates.size());
}

// The left and right halves differ. Far from the boundary the rates follow the formula.
TEST(SamplingPlan, RatesFollowErrorAndCost) {
  const auto noise = [](int x, int) { return x < 24 ? 0.1 : 0.3; };
  const auto rays = [](int x, int) { return x < 24 ? 1 : 4; };
  const Film film = film_of(48, 8, noise, rays);
  const SamplingPlan plan = adaptive_plan(film, 0.1);
  EXPECT_NEAR(mean(plan.rates), 1, 1e-5);
  const std::size_t quiet = 3 * 48 + 5, noisy = 3 * 48 + 43;
  EXPECT_NEAR(plan.rates[noisy] / plan.rates[quiet], 3 / 2.0, 1e-4); // noise / sqrt(rays)
  const SamplingPlan worst = adaptive_plan(film, 0.01, ErrorScope::worst_block);
  EXPECT_NEAR(worst.rates[noisy] / worst.rates[quiet], 9, 1e-3);
  EXPECT_NEAR(mean(worst.rates), 1, 1e-5);
  const SamplingPlan least = adaptive_plan(film, 0.9);
  EXPECT_NEAR(least.rates[quiet], 0.9, 1e-6);
  EXPECT_NEAR(mean(least.rates), 1, 1e-5);
  EXPECT_EQ(plan.samples(quiet, 100), std::uint32_t(std::lround(100 * plan.rates[quiet])));
  EXPECT_EQ(SamplingPlan().samples(quiet, 7), 7u);
}

TEST(SamplingPlan, BorderHasTheRatesOfTheNearestPixels) {
  const SamplingPlan plan = SamplingPlan{.rates = {1, 3}, .light_path_scale = 2}.with_border(2, 1, 1, 16);
  ASSERT_EQ(plan.rates.size(), 4u * 3);
  EXPECT_NEAR(mean(plan.rates), 1, 1e-6);
  for (std::size_t i = 0; i < plan.rates.size(); ++i) EXPECT_NEAR(plan.rates[i], i % 4 < 2 ? 0.5 : 1.5, 1e-6);
  EXPECT_EQ(plan.light_path_scale, 2);
  EXPECT_EQ(plan.samples(0, 16), 16u);
  EXPECT_EQ(plan.samples(0, 64), 16u + 24);
  EXPECT_EQ(plan.samples(3, 64), 16u + 72);
  EXPECT_TRUE(SamplingPlan().with_border(2, 1, 1, 16).rates.empty());
}

// All pixels of a tile have one rate, which depends on neighbouring tiles only. The edges of the film may cut tiles.
TEST(SamplingPlan, TileRatesFollowNeighbourTiles) {
  const auto rays = [](int, int) { return 3; };
  std::vector<double> noise(39 * 41);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = i % 39 < 20 ? 0.1 : 1;
  const auto at = [&](int x, int y) { return noise[39 * std::size_t(y) + std::size_t(x)]; };
  const Tiling tiling{2, 1, 0};
  const auto plan = [&] { return adaptive_plan(film_of(39, 41, at, rays), 0.01, ErrorScope::image, 0, tiling); };
  const SamplingPlan before = plan();
  const auto rate = [](const SamplingPlan& p, int x, int y) { return p.rates[39 * std::size_t(y) + std::size_t(x)]; };
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 39; ++x) EXPECT_EQ(rate(before, x, y), rate(before, x - (x > 0 && x % 2 == 0), y - y % 2));
  EXPECT_GT(rate(before, 30, 20), 5 * rate(before, 3, 20));
  noise[39 * 17 + 21] = 3; // in the tile of columns 21, 22 and rows 16, 17
  const SamplingPlan after = plan();
  const auto ratio = [&](int x, int y) { return double(rate(after, x, y)) / double(rate(before, x, y)); };
  for (const int x : {21, 22})
    for (const int y : {16, 17}) EXPECT_NEAR(ratio(x, y), ratio(3, 20), 1e-6);
  EXPECT_GT(ratio(23, 17), 1.05 * ratio(3, 20));
  EXPECT_GT(ratio(20, 15), 1.05 * ratio(3, 20));
}

// A pixel's own samples change its rate only by its share in the mean of all rates.
TEST(SamplingPlan, RateFollowsNeighboursOnly) {
  const auto rays = [](int, int) { return 3; };
  std::vector<double> noise(40 * 40);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = i % 40 < 20 ? 0.1 : 1;
  const auto at = [&](int x, int y) { return noise[40 * std::size_t(y) + std::size_t(x)]; };
  const SamplingPlan before = adaptive_plan(film_of(40, 40, at, rays), 0.01);
  const std::size_t pixel = 17 * 40 + 21, neighbour = pixel + 1, far = pixel + 12;
  noise[pixel] = 3;
  const SamplingPlan after = adaptive_plan(film_of(40, 40, at, rays), 0.01);
  const auto ratio = [&](std::size_t i) { return double(after.rates[i]) / double(before.rates[i]); };
  EXPECT_NEAR(ratio(pixel), ratio(far), 1e-6);
  EXPECT_GE(ratio(neighbour), 1.2);
  EXPECT_NEAR(ratio(far), 1, 0.02);
}

// A pixel's own radiance does not change its rate either, although the neighbours' variances are relative to the
// radiance around them.
TEST(SamplingPlan, RateIgnoresPixelsOwnRadiance) {
  const auto plan = [](double radiance) {
    Film film(40, 40, 2);
    for (int i = 0; i < 40 * 40; ++i) {
      const double value = i == 17 * 40 + 21 ? radiance : i % 40 < 20 ? 1 : 0.3;
      for (const int set : {0, 1})
        film.add(i % 40, i / 40, set, Eigen::Array3d::Constant(8 * value * (1 + (set - 0.5) / 10)), 8);
      film.record_samples(i % 40, i / 40, {}, 48);
    }
    return adaptive_plan(film, 0.01).rates;
  };
  const std::vector<float> before = plan(0.3), after = plan(0.01);
  const std::size_t pixel = 17 * 40 + 21;
  const auto ratio = [&](std::size_t i) { return double(after[i]) / double(before[i]); };
  EXPECT_NEAR(ratio(pixel), ratio(pixel + 12), 1e-3); // the mean of the image and the sum of the rates change a little
  EXPECT_LT(ratio(pixel + 1), 0.99 * ratio(pixel + 12)); // the rates of the neighbours change
}

// Rare bright samples are not divided by themselves, and a lamp does not hide the noise of its neighbours.
TEST(SamplingPlan, BrightPixels_KeepNeighbourRates) {
  const auto rates = [](auto&& radiance, auto&& noise) {
    Film film(40, 1, 2);
    for (int x = 0; x < 40; ++x) {
      for (const int set : {0, 1})
        film.add(x, 0, set, Eigen::Array3d::Constant(8 * radiance(x) * (1 + (set - 0.5) * noise(x) / 2)), 8);
      film.record_samples(x, 0, {}, 16);
    }
    return adaptive_plan(film, 0.001).rates;
  };
  const auto bright = [](int x) { return x > 20 && x % 2 == 0; };
  const std::vector<float> rare =
      rates([&](int x) { return bright(x) ? 4 : 1; }, [&](int x) { return bright(x) ? 0.5 : 0.05; });
  EXPECT_GT(rare[33], 6 * rare[5]); // 4 if samples were divided by their own squares
  const std::vector<float> lamp =
      rates([](int x) { return x == 20 ? 100 : 1; }, [](int x) { return x == 20 ? 0.01 : 0.5; });
  EXPECT_NEAR(lamp[18] / lamp[2], 1, 0.1); // 0.6 if the noise of pixel 19 were divided by the light of pixel 20
}

// The number of light paths minimizes variance times rays, within [1, 4].
TEST(SamplingPlan, LightPathScaleFollowsVariance) {
  const auto plan = [](double noise, std::uint64_t rays) {
    Film film(8, 8, 2, {.has_light_paths = true});
    for (int i = 0; i < 64; ++i) {
      for (const int set : {0, 1}) {
        film.add(i % 8, i / 8, set, Eigen::Array3d::Constant(8 * (1 + (set - 0.5) / 10)), 8);
        film.add_light_splat(i % 8, i / 8, set, Eigen::Array3d::Constant(8 * (1 + (set - 0.5) * noise)));
      }
      film.record_samples(i % 8, i / 8, {}, 16 * 5);
    }
    for (const int set : {0, 1}) film.add_light_path_count(set, 8);
    film.add_light_rays(64 * 16 * rays);
    EXPECT_NEAR(film.light_rays(), 64 * double(rays), 1e-9);
    const SamplingPlan p = adaptive_plan(film, 0.25);
    // The largest contribution of a path is half of a set's sum, and its square is in the variance of pixels.
    const double light_variance = film.estimate(3, 3).light_variance[0],
                 of_samples = film.estimate(3, 3).variance[0] - light_variance;
    EXPECT_NEAR(p.light_path_scale, std::clamp(std::sqrt(light_variance * 5 / (of_samples * double(rays))), 1.0, 4.0),
                1e-6);
    return p.light_path_scale;
  };
  EXPECT_GT(plan(0.3, 40), 1.1);
  EXPECT_LT(plan(0.3, 40), 3.9);
  EXPECT_EQ(plan(0.3, 5000), 1);
  EXPECT_EQ(plan(3, 1), 4);
  EXPECT_EQ(adaptive_plan(film_of(
                              8, 8, [](int x, int) { return x; }, [](int, int) { return 1; }),
                          0.25)
                .light_path_scale,
            1);
}

// Isolated noisy pixels, which neighbours do not predict: even sampling is best for all other pixels.
TEST(SamplingPlan, UncorrelatedNeighbours_GiveUniformRates) {
  mc::Pcg random(2);
  std::vector<double> noise(30 * 30);
  for (double& n : noise) n = random.uniform<double>() < 0.01 ? 5 : 0.01;
  const auto at = [&](int x, int y) { return noise[30 * std::size_t(y) + std::size_t(x)]; };
  const SamplingPlan plan = adaptive_plan(film_of(30, 30, at, [](int, int) { return 2; }), 0.1);
  double even = 0, spent = 0;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    even += mc::sqr(noise[i]);
    spent += mc::sqr(noise[i]) / double(plan.rates[i]);
  }
  EXPECT_LE(spent, 1.01 * even);
}

TEST(SamplingPlan, ThreadsDoNotChangeIt) {
  const auto noise = [](int x, int y) { return 0.01 * (x * y % 7); };
  const Film film = film_of(33, 21, noise, [](int x, int) { return 1 + x; });
  EXPECT_EQ(adaptive_plan(film, 0.2, ErrorScope::image, 1).rates, adaptive_plan(film, 0.2, ErrorScope::image, 3).rates);
}

TEST(SamplingPlan, ZeroVariance_GivesUniformRates) {
  const auto one = [](int, int) { return 1; };
  const SamplingPlan quiet = adaptive_plan(film_of(
                                               5, 4, [](int, int) { return 0; }, one),
                                           0.25);
  EXPECT_EQ(quiet.samples(3, 12), 12u);
  const SamplingPlan alone = adaptive_plan(film_of(1, 1, one, one), 0.25); // no neighbours
  EXPECT_EQ(alone.samples(0, 12), 12u);
  EXPECT_EQ(adaptive_plan(Film(3, 3, 4), 0.25).samples(0, 5), 5u); // no samples
  for (const double least : {0.0, -1.0, 1.5, std::nan("")})
    EXPECT_THROW(adaptive_plan(Film(3, 3, 4), least), mc::Error) << least;
}

} // namespace
