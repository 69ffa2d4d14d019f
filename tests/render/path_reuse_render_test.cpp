// Renders with path reuse in tiles.

#include <render/integrator/light_tracer.h>

#include <mc/core/error.h>
#include <mc/random/pcg.h>

#include "support/picture_seeds.h"
#include "support/random_scene.h"

namespace {

using namespace support;

RenderOptions options_of_tiles(int spp) {
  RenderOptions options;
  options.width = 13;
  options.height = 11;
  options.spp = spp;
  options.tiles = true;
  return options;
}

/// A lamp above a floor and a ball, between two walls.
Scene corner() {
  SceneBuilder builder;
  const BsdfId tan = builder.add(Lambert(Spectrum(Float(0.8), Float(0.6), Float(0.4))));
  const auto wall = [&](const Vec3d& at, const Vec3d& axis, double degrees) {
    builder.add(TriangleMesh::rectangle(Transform::translate(at) * Transform::rotate(axis, degrees) *
                                        Transform::scale({3, 3, 1})),
                {tan});
  };
  wall({0, -1, 0}, Vec3d::UnitX(), -90);
  wall({0, 0, -1.5}, Vec3d::UnitX(), 0);
  wall({-1.5, 0, 0}, Vec3d::UnitY(), 90);
  builder.add(Sphere(Vec3d(0.3, -0.4, 0), 0.6), {tan});
  builder.add(Sphere(Vec3d(0, 3, 1), 0.4), {builder.add(Lambert(Spectrum::Zero())), Emission{Spectrum::Constant(10)}});
  builder.set(ThinLens(Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), {.fov_axis = FovAxis::y, .fov = 28}));
  return builder.build();
}

// Thirty rooms with area or point lights and 16 images of each method. Strategies that find the lights, samplers, and
// tiles alone or what a render chooses by default alternate.
TEST(PathReuseRender, MeanMatchesRenderWithoutReuse) {
  Agreement agreement;
  for (std::uint64_t i = 0; agreement.scenes < 30; ++i) {
    const Scene scene = RandomScene(3000 + i, i % 4 == 0 ? RandomLights::deltas : RandomLights::lamps).build();
    RenderOptions options = options_of(i, 48), much = options_of(i, 192);
    options.strategy = much.strategy = strategy_from(std::array{"mis+lt", "mis", "nee"}[i % 3]);
    options.sampler = std::array{PixelSampler::sobol, PixelSampler::independent, PixelSampler::stratified}[i / 3 % 3];
    RenderOptions shared = options;
    shared.seed += 1'000'000;
    options.tiles = options.adaptive = options.splat = false;
    if (i % 2 == 0) shared.tiles = true, shared.adaptive = shared.splat = false;
    const Image reference = render::render(scene, much).image;
    if (std::all_of(reference.pixels.begin(), reference.pixels.end(), is_black)) continue;
    const std::vector<Spectrum> unit = pixel_units(reference);
    const mc::Moments one = picture_means(scene, options, 16, unit);
    agreement.add(i, one, picture_means(scene, shared, 16, unit),
                  2.05); // Student's t with about 28 degrees of freedom
  }
  EXPECT_LE(agreement.outliers, 5); // of 30 at 5 %: more than 5 with probability 1/300
}

// Including a room in which light paths pay.
TEST(PathReuseRender, SameBitsForAnyNumberOfThreadsAndAnyPart) {
  for (const Scene& scene : {corner(), RandomScene(100).build()})
    for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
      RenderOptions options = options_of_tiles(12);
      options.sampler = sampler;
      options.threads = 1;
      const Image whole = render::render(scene, options).image;
      options.threads = 3;
      EXPECT_EQ(count_different_pixels(render::render(scene, options).image, whole), 0) << name(sampler);
      for (const Crop& crop : {Crop{0, 0, 4, 5}, Crop{5, 4, 8, 7}, Crop{7, 3, 1, 1}, Crop{12, 10, 1, 1}}) {
        options.crop = crop;
        const RenderResult part = render::render(scene, options);
        EXPECT_EQ(count_different_pixels(part.image, whole, crop.x, crop.y), 0) << name(sampler);
        EXPECT_EQ(part.spp, 12);
      }
    }
}

TEST(PathReuseRender, IsUnbiasedWithHonestErrorBars) {
  const Scene scene = corner();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    SCOPED_TRACE(name(sampler));
    RenderOptions options = options_of_tiles(16);
    options.sampler = sampler;
    const SeedEnsemble tiles(scene, options, 0);
    options.tiles = false;
    options.branches = 2;
    expect_same_statistics(tiles, SeedEnsemble(scene, options, 1000));
  }
}

// Adaptive sampling of tiles does not change the mean.
TEST(PathReuseRender, Adaptive_IsUnbiased) {
  const Scene scene = corner();
  RenderOptions options = options_of_tiles(48);
  options.adaptive = true;
  const SeedEnsemble tiles(scene, options, 0);
  options.tiles = false;
  options.adaptive = false;
  expect_same_statistics(tiles, SeedEnsemble(scene, options, 1000));
}

/// Many small balls of two materials under a white sky.
Scene balls() {
  SceneBuilder builder;
  const BsdfId orange = builder.add(Lambert(Spectrum(Float(0.8), Float(0.3), Float(0.1)))),
               metal = builder.add(RoughConductor<TrowbridgeReitzFacets>(
                   Spectrum::Constant(Float(0.5)), Spectrum::Constant(3), TrowbridgeReitzFacets(Float(0.2))));
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  mc::Pcg random(1);
  for (int i = 0; i < 400; ++i) {
    const mc::Vec3<double> u = random.point<double, 3>();
    builder.add(Sphere(4 * u - Vec3d::Constant(2), 0.12), {i % 2 == 0 ? orange : metal});
  }
  builder.set(ThinLens(Transform::look_at({0, 0, 9}, {0, 0, 0}, {0, 1, 0}), {.fov_axis = FovAxis::y, .fov = 28}));
  return builder.build();
}

// A room of diffuse walls, and balls of which neighbouring pixels show different ones.
TEST(PathReuseRender, PilotChoosesTilesWhereTheyPay) {
  RenderOptions options;
  options.width = 48;
  options.height = 40;
  options.spp = 64;
  EXPECT_EQ(render::render(corner(), options).image.noise_area, 4);
  EXPECT_EQ(render::render(balls(), options).image.noise_area, 1.21875) << "a third of 14 of 64 samples";
  options.tiles = false;
  EXPECT_EQ(render::render(corner(), options).image.noise_area, 1);
  options.tiles.reset();
  options.branches = 2;
  EXPECT_EQ(render::render(corner(), options).image.noise_area, 1);
}

TEST(PathReuseRender, ReportsNoiseArea) {
  const RenderResult tiles = render::render(corner(), options_of_tiles(8));
  EXPECT_EQ(tiles.image.noise_area, 4);
  EXPECT_EQ(tiles.samples, 13u * 11 * 8);
}

TEST(PathReuseRender, StopsByTimeErrorOrCancelWithWholeRounds) {
  const Scene scene = corner();
  RenderOptions options = options_of_tiles(16);
  options.target_error = 0.1;
  const RenderResult by_error = render::render(scene, options);
  EXPECT_LE(by_error.relative_error, 0.1);
  options.target_error.reset();
  options.seconds = 0.05;
  const RenderResult by_time = render::render(scene, options);
  EXPECT_GE(by_time.spp, 2);
  EXPECT_FALSE(by_time.image.variance.empty());
  std::atomic<bool> cancel = true;
  options.cancel = &cancel;
  EXPECT_TRUE(render::render(scene, options).partial);
}

TEST(PathReuseRender, RejectsIncompatibleOptions) {
  const Scene scene = corner();
  RenderOptions options = options_of_tiles(16);
  options.branches = 2;
  EXPECT_THROW(render::render(scene, options), mc::Error);
  options.branches.reset();
  options.aov = Aov::normals;
  EXPECT_THROW(render::render(scene, options), mc::Error);
}

} // namespace
