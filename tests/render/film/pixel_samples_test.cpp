#include <render/film/pixel_samples.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace render;

struct SplatRow {
  const char* name;
  Filter filter;
  double variance; ///< Variance along one axis.
};

const std::array splat_rows = {SplatRow{"wide box", BoxFilter(Float(1.5)), 0.75},
                               SplatRow{"tent", TentFilter(), 1 / 6.0},
                               SplatRow{"wide tent", TentFilter(Float(2.25)), 2.25 * 2.25 / 6},
                               SplatRow{"gaussian", GaussianFilter(), 0.25},
                               SplatRow{"wide gaussian", GaussianFilter(1), 1},
                               SplatRow{"smallpt", SubpixelTentFilter(), 0.25 / 6 + 0.0625}};

/// Splats onto a film of one pixel, from `n` samples in each set and square. The radiance is (1 + x^2 + y, 5, x) at the
/// distance (x, y) from the pixel's centre. The squares extend one pixel beyond the filter's reach.
PixelEstimate splatted(const SplatFilter& filter, int n, mc::Pcg& random) {
  Film film(1, 1, 4, {.splat = filter});
  FilmBlock block(1, 1, 4);
  const std::optional splats(filter);
  PixelSamples pixel(splats);
  const int around = filter.reach() + 1;
  for (int y = -around; y <= around; ++y)
    for (int x = -around; x <= around; ++x)
      for (int set = 0; set < 4; ++set) {
        for (int i = 0; i < n; ++i) {
          const Vec2 offset(random.uniform<Float>() - Float(0.5), random.uniform<Float>() - Float(0.5));
          const Float px = Float(x) + offset[0], py = Float(y) + offset[1];
          pixel.add(offset, Spectrum(1 + px * px + py, 5, px));
        }
        pixel.end_set(block, x, y, set);
      }
  film.add(block);
  return film.estimate(0, 0);
}

// Splats give the filtered image without bias for every filter, with a valid error bar; a constant channel has no
// noise. With 3,000 pixels alpha is 0.006 % for each mean. The variances are accurate to 3 %, and their bound is five
// times that.
TEST(PixelSamples, PixelsAreFilteredWithoutBias) {
  mc::Pcg random(8);
  for (const SplatRow& row : splat_rows) {
    const SplatFilter filter(row.filter);
    mc::Moments red, blue;
    Eigen::Array3d variance = Eigen::Array3d::Zero();
    for (int i = 0; i < 3000; ++i) {
      const PixelEstimate pixel = splatted(filter, 2, random);
      EXPECT_NEAR(pixel.mean[1], 5, 1e-5) << row.name;
      red.add(pixel.mean[0]);
      blue.add(pixel.mean[2]);
      variance += pixel.variance / 3000;
    }
    EXPECT_LE(variance[1], 1e-10) << row.name;
    EXPECT_NEAR(red.mean(), 1 + row.variance, 4 * red.std_error() + 1e-5) << row.name;
    EXPECT_NEAR(blue.mean(), 0, 4 * blue.std_error()) << row.name;
    EXPECT_NEAR(variance[0] / red.variance(), 1, 0.15) << row.name;
    EXPECT_NEAR(variance[2] / blue.variance(), 1, 0.15) << row.name;
  }
}

// A single set is unbiased, too, although no other set corrects its weights.
TEST(PixelSamples, SingleSet_IsUnbiased) {
  mc::Pcg random(4);
  const SplatFilter filter{Filter(GaussianFilter())};
  mc::Moments means;
  for (int i = 0; i < 20'000; ++i) {
    Film film(1, 1, 1, {.splat = filter});
    FilmBlock block(1, 1, 1);
    const std::optional splats(filter);
    PixelSamples pixel(splats);
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) {
        pixel.add(Vec2(random.uniform<Float>() - Float(0.5), random.uniform<Float>() - Float(0.5)),
                  Spectrum::Constant(Float(x + y + 3)));
        pixel.end_set(block, x, y, 0);
      }
    film.add(block);
    means.add(film.estimate(0, 0).mean[0]);
  }
  EXPECT_NEAR(means.mean(), 3, 4 * means.std_error());
}

} // namespace
