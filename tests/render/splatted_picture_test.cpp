#include <render/render.h>
#include <render/scene/builder.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace render;

/// A ball on a plane, both in view, under a spherical lamp that is not, and a dim sky.
Scene ball_on_plane(const Filter& filter) {
  SceneBuilder builder;
  const BsdfId tan = builder.add(Lambert(Spectrum(Float(0.8), Float(0.6), Float(0.4))));
  builder.add(Light(ConstantBackground(Spectrum(Float(0.1), Float(0.2), Float(0.3)))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {tan});
  builder.add(Sphere(Vec3d(0.3, -0.4, 0), 0.6), {tan});
  builder.add(Sphere(Vec3d(0, 3, 1), 0.4), {tan, Emission{Spectrum::Constant(10)}});
  builder.set(filter);
  builder.set(ThinLens(Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), {.fov_axis = FovAxis::y, .fov = 28}));
  return builder.build();
}

RenderOptions splatted(int spp) {
  RenderOptions options;
  options.width = 13;
  options.height = 11;
  options.spp = spp;
  options.splat = true;
  return options;
}

int differences(const Image& a, const Image& b, int dx = 0, int dy = 0) {
  int different = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      different += !(a.at(x, y) == b.at(x + dx, y + dy)).all() ||
                   !(a.variance[a.index(x, y)] == b.variance[b.index(x + dx, y + dy)]).all();
  return different;
}

TEST(SplattedPicture, SameBitsForAnyNumberOfThreadsAndAnyPart) {
  for (const Filter& filter : {Filter(GaussianFilter()), Filter(TentFilter()), Filter(BoxFilter(Float(3.7)))}) {
    const Scene scene = ball_on_plane(filter);
    for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
      RenderOptions options = splatted(12);
      options.sampler = sampler;
      options.threads = 1;
      const Image whole = render::render(scene, options).image;
      options.threads = 3;
      EXPECT_EQ(differences(render::render(scene, options).image, whole), 0) << name(sampler);
      for (const Crop& crop : {Crop{0, 0, 4, 5}, Crop{5, 4, 8, 7}, Crop{7, 3, 1, 1}}) {
        options.crop = crop;
        const RenderResult part = render::render(scene, options);
        EXPECT_EQ(differences(part.image, whole, crop.x, crop.y), 0) << name(sampler);
        EXPECT_EQ(part.spp, 12);
      }
    }
  }
}

// A filter that is no wider than a pixel has nothing to share: its pictures stay as they are.
TEST(SplattedPicture, OfANarrowFilterIsAsWithout) {
  const Scene scene = ball_on_plane(BoxFilter());
  RenderOptions options = splatted(8);
  const Image a = render::render(scene, options).image;
  options.splat = false;
  EXPECT_EQ(differences(a, render::render(scene, options).image), 0);
  EXPECT_EQ(a.noise_area, 1);
}

/// Of 150 seeds: of the sum of each picture and of each pixel, in green, and what the pictures say of it.
struct SplatSeeds {
  mc::Moments sums;
  std::vector<mc::Moments> pixels = std::vector<mc::Moments>(13 * 11);
  double variance = 0; ///< stated, of the sum
  std::vector<double> variances = std::vector<double>(13 * 11);

  SplatSeeds(const Scene& scene, RenderOptions options, std::uint64_t first) {
    constexpr int seeds = 150;
    for (options.seed = first; options.seed < first + seeds; ++options.seed) {
      const Image image = render::render(scene, options).image;
      double sum = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i].add(double(image.pixels[i][1]));
        sum += double(image.pixels[i][1]);
        variances[i] += double(image.variance[i][1]) / seeds;
        variance += double(image.variance[i][1]) * image.noise_area / seeds;
      }
      sums.add(sum);
    }
  }
};

// Pictures of splats have the expectation of pictures without, pixel by pixel, at the edges too, and less noise, as
// much as they say. 150 seeds: alpha is 0.1 % for the sum and for the pixels. The mean of the stated variances is that
// of the pixels within 12 % (four of its standard errors), and at least that of the sum, since pixels at the edge share
// their noise with some that are not there.
TEST(SplattedPicture, IsUnbiasedWithHonestErrorBars) {
  for (const Filter& filter : {Filter(GaussianFilter()), Filter(TentFilter())}) {
    const Scene scene = ball_on_plane(filter);
    for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
      RenderOptions options = splatted(16);
      options.sampler = sampler;
      const SplatSeeds splat(scene, options, 0);
      options.splat = false;
      const SplatSeeds own(scene, options, 1000);
      const double error = std::hypot(splat.sums.std_error(), own.sums.std_error());
      EXPECT_LE(std::abs(splat.sums.mean() - own.sums.mean()), 3.29 * error) << name(sampler);
      double squares = 0, compared = 0, stated = 0, is = 0, was = 0;
      for (std::size_t i = 0; i < splat.pixels.size(); ++i) {
        const mc::Moments &a = splat.pixels[i], &b = own.pixels[i];
        if (b.variance() > 0) {
          squares += mc::sqr(a.mean() - b.mean()) / (mc::sqr(a.std_error()) + mc::sqr(b.std_error()));
          ++compared;
        } else { // 2400 samples of one colour; splats may have met another beside it
          EXPECT_NEAR(a.mean() / b.mean(), 1, 0.002) << name(sampler) << " " << i;
        }
        stated += splat.variances[i];
        is += a.variance();
        was += b.variance();
      }
      EXPECT_GE(compared, 70);
      EXPECT_GE(mc::chi_square_tail(squares, compared), 0.001) << name(sampler);
      EXPECT_NEAR(stated / is, 1, 0.12) << name(sampler);
      EXPECT_LE(is / was, 0.6) << name(sampler);
      EXPECT_LE(splat.sums.variance() / splat.variance, 1.36) << name(sampler); // chi-square of 149: 0.1 %
      EXPECT_GE(splat.sums.variance() / splat.variance, 0.3) << name(sampler);
    }
  }
}

TEST(SplattedPicture, StopsByTimeErrorOrCancelWithWholeRounds) {
  const Scene scene = ball_on_plane(GaussianFilter());
  RenderOptions options = splatted(16);
  options.target_error = 0.05;
  const RenderResult by_error = render::render(scene, options);
  EXPECT_LE(by_error.relative_error, 0.05);
  EXPECT_EQ(by_error.spp, std::round(by_error.spp)) << "rows differ";
  options.target_error.reset();
  options.seconds = 0.05;
  const RenderResult by_time = render::render(scene, options);
  EXPECT_GE(by_time.spp, 4);
  EXPECT_EQ(by_time.spp, std::round(by_time.spp)) << "rows differ";
  EXPECT_FALSE(by_time.partial);
  // Cancelled in the second round: the first is whole.
  std::atomic<bool> cancel = false;
  options = splatted(1 << 20);
  options.cancel = &cancel;
  options.progress = [&](const Progress& p) { cancel = p.samples > 6u * 17 * 15; };
  const RenderResult cancelled = render::render(scene, options);
  EXPECT_TRUE(cancelled.partial);
  EXPECT_EQ(cancelled.spp, 4);
  EXPECT_FALSE(cancelled.image.variance.empty());
  options.adaptive = true;
  EXPECT_THROW(render::render(scene, options), mc::Error);
}

} // namespace
