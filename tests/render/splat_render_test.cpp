#include <render/scene/builder.h>

#include <mc/core/error.h>

#include "support/picture_seeds.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace {

using namespace render;
using namespace support;

/// A ball on a plane in view, under a spherical lamp outside the view and a dim sky.
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

TEST(SplatRender, SameBitsForAnyNumberOfThreadsAndAnyPart) {
  for (const Filter& filter : {Filter(GaussianFilter()), Filter(TentFilter()), Filter(BoxFilter(Float(3.7)))}) {
    const Scene scene = ball_on_plane(filter);
    for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
      RenderOptions options = splatted(12);
      options.adaptive = false;
      options.sampler = sampler;
      options.threads = 1;
      const Image whole = render::render(scene, options).image;
      options.threads = 3;
      EXPECT_EQ(count_different_pixels(render::render(scene, options).image, whole), 0) << name(sampler);
      for (const Crop& crop : {Crop{0, 0, 4, 5}, Crop{5, 4, 8, 7}, Crop{7, 3, 1, 1}}) {
        options.crop = crop;
        const RenderResult part = render::render(scene, options);
        EXPECT_EQ(count_different_pixels(part.image, whole, crop.x, crop.y), 0) << name(sampler);
        EXPECT_EQ(part.spp, 12);
      }
    }
  }
}

// A filter that is no wider than a pixel has nothing to share: images stay the same.
TEST(SplatRender, FilterOfOnePixel_EqualsUnsplatted) {
  const Scene scene = ball_on_plane(BoxFilter());
  RenderOptions options = splatted(8);
  options.adaptive = false;
  const Image a = render::render(scene, options).image;
  options.splat = false;
  EXPECT_EQ(count_different_pixels(a, render::render(scene, options).image), 0);
  EXPECT_EQ(a.noise_area, 1);
}

// Also at the edges, and with less noise. The stated error of the sum is too large, since pixels at the edge share
// noise with pixels outside the film.
TEST(SplatRender, IsUnbiasedWithHonestErrorBars) {
  for (const Filter& filter : {Filter(GaussianFilter()), Filter(TentFilter())}) {
    const Scene scene = ball_on_plane(filter);
    for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
      SCOPED_TRACE(name(sampler));
      RenderOptions options = splatted(16);
      options.sampler = sampler;
      const SeedEnsemble splat(scene, options, 0);
      options.splat = false;
      EXPECT_LE(expect_same_statistics(splat, SeedEnsemble(scene, options, 1000)), 0.6);
      EXPECT_GE(splat.sums.variance() / splat.variance, 0.3);
    }
  }
}

TEST(SplatRender, StopsByTimeOrError) {
  const Scene scene = ball_on_plane(GaussianFilter());
  RenderOptions options = splatted(16);
  options.adaptive = false;
  options.target_error = 0.05;
  const RenderResult by_error = render::render(scene, options);
  EXPECT_LE(by_error.relative_error, 0.05);
  EXPECT_EQ(by_error.spp, std::round(by_error.spp)) << "rows differ";
  options.target_error.reset();
  options.seconds = 0.05;
  const RenderResult by_time = render::render(scene, options);
  EXPECT_GE(by_time.spp, 1);
  EXPECT_FALSE(by_time.partial);
}

// Cancelled in the third pass after 8 of 15 rows, with two rows of the border on each side. The first four rows of the
// picture have all splats of this pass, and the others keep those of the passes before.
TEST(SplatRender, Cancelled_RowsKeepWhatIsComplete) {
  const Scene scene = ball_on_plane(GaussianFilter());
  RenderOptions options = splatted(4);
  options.adaptive = false;
  options.threads = 1; // several might render all rows of the pass while the first is under way
  const Image before = render::render(scene, options).image;
  options.spp = 8;
  const Image after = render::render(scene, options).image;
  std::atomic<bool> cancel = false;
  options.spp = 1 << 20;
  options.cancel = &cancel;
  options.progress = [&](const Progress& p) { cancel = p.samples > 6u * 17 * 15; };
  const RenderResult cut = render::render(scene, options);
  EXPECT_TRUE(cut.partial);
  EXPECT_EQ(cut.samples, 17u * (15 * 4 + 8 * 4));
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 13; ++x) {
      const Image& expected = y < 4 ? after : before;
      EXPECT_TRUE((cut.image.at(x, y) == expected.at(x, y)).all()) << x << " " << y;
    }
}

// Splats of pixels with different numbers of samples, of tiles, and both.
TEST(SplatRender, AdaptiveAndTiles_AreUnbiased) {
  const Scene scene = ball_on_plane(GaussianFilter());
  for (const auto& [adaptive, tiles] : {std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    SCOPED_TRACE(fmt::format("adaptive {}, tiles {}", adaptive, tiles));
    RenderOptions options = splatted(48);
    options.adaptive = adaptive;
    options.tiles = tiles;
    const SeedEnsemble shared(scene, options, 0);
    options.tiles = options.adaptive = options.splat = false;
    expect_same_statistics(shared, SeedEnsemble(scene, options, 1000));
  }
}

TEST(SplatRender, Tiles_SameBitsForAnyNumberOfThreadsAndAnyPart) {
  const Scene scene = ball_on_plane(GaussianFilter());
  RenderOptions options = splatted(12);
  options.tiles = true;
  options.threads = 1;
  const Image whole = render::render(scene, options).image;
  options.threads = 3;
  EXPECT_EQ(count_different_pixels(render::render(scene, options).image, whole), 0);
  for (const Crop& crop : {Crop{0, 0, 4, 5}, Crop{5, 4, 8, 7}, Crop{7, 3, 1, 1}, Crop{3, 2, 6, 6}}) {
    options.crop = crop;
    EXPECT_EQ(count_different_pixels(render::render(scene, options).image, whole, crop.x, crop.y), 0);
  }
}

} // namespace
