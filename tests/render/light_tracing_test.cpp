// Random scenes: light paths and camera paths together agree with camera paths alone.

#include <render/integrator/light_tracer.h>

#include "support/random_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace support;

// Sixty rooms with 16 images of each method. The ways to render alternate.
TEST(LightTracingRender, MatchesMisImages) {
  Agreement agreement;
  for (std::uint64_t i = 0; agreement.scenes < 30; ++i) {
    const Scene scene = RandomScene(i).build();
    if (!LightTracer::create(scene, strategy_from("mis+lt"), 1)) continue;
    RenderOptions options = options_of(i, 64), much = options_of(i, 256);
    options.strategy = much.strategy = strategy_from("mis");
    options.adaptive = much.adaptive = false;
    const std::vector<Spectrum> unit = pixel_units(render::render(scene, much).image);
    const mc::Moments one = picture_means(scene, options, 16, unit);
    options.strategy = strategy_from("mis+lt");
    options.sampler = std::array{PixelSampler::sobol, PixelSampler::independent, PixelSampler::stratified}[i % 3];
    options.adaptive = i % 5 == 1;
    options.splat = i % 5 == 2;
    agreement.add(i, one, picture_means(scene, options, 16, unit),
                  2.05); // Student's t with about 28 degrees of freedom
  }
  EXPECT_LE(agreement.outliers, 6); // of 30 at 5 %: more than 6 with probability 1/1600
}

// Twenty rooms with point and directional lights, against small spherical lights in their place, which camera paths can
// hit.
TEST(LightTracingRender, DeltaLights_MatchSmallSphereLights) {
  Agreement agreement;
  for (std::uint64_t i = 0; agreement.scenes < 20; ++i) {
    const Scene deltas = RandomScene(i, RandomLights::deltas).build(),
                spheres = RandomScene(i, RandomLights::spheres).build();
    if (!LightTracer::create(deltas, strategy_from("mis+lt"), 1)) continue;
    const RenderOptions options = options_of(i, 256);
    const Image reference = render::render(spheres, options).image;
    if (std::all_of(reference.pixels.begin(), reference.pixels.end(), is_black)) continue;
    const std::vector<Spectrum> unit = pixel_units(reference);
    agreement.add(i, picture_means(spheres, options, 12, unit), picture_means(deltas, options, 12, unit),
                  2.07); // about 22 degrees of freedom
  }
  EXPECT_LE(agreement.outliers, 5); // of 20 at 5 %: more than 5 with probability 1/3000
}

/// A room in which light paths pay.
Scene lit_room() {
  for (std::uint64_t i = 100;; ++i)
    if (Scene scene = RandomScene(i).build(); LightTracer::create(scene, strategy_from("mis+lt"), 1)) return scene;
}

TEST(LightTracingRender, SameBitsForAnyNumberOfThreadsAndAnyPart) {
  const Scene scene = lit_room();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    RenderOptions options;
    options.width = 11;
    options.height = 9;
    options.spp = 12;
    options.sampler = sampler;
    options.threads = 1;
    const Image whole = render::render(scene, options).image;
    options.threads = 3;
    const Image threaded = render::render(scene, options).image;
    options.crop = Crop{3, 2, 5, 6};
    const Image part = render::render(scene, options).image;
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 11; ++x) {
        EXPECT_TRUE((threaded.at(x, y) == whole.at(x, y)).all());
        if (x < 3 || x >= 8 || y < 2 || y >= 8) continue;
        EXPECT_TRUE((part.at(x - 3, y - 2) == whole.at(x, y)).all()) << x << " " << y;
        EXPECT_TRUE((part.variance[part.index(x - 3, y - 2)] == whole.variance[whole.index(x, y)]).all());
      }
  }
}

TEST(LightTracingRender, ShortPaths_SkipLightTracing) {
  const Scene scene = lit_room();
  RenderOptions options = options_of(0, 12);
  options.max_depth = 2;
  const RenderResult two = render::render(scene, options);
  options.strategy = strategy_from("mis");
  const RenderResult one = render::render(scene, options);
  EXPECT_EQ(two.rays, one.rays);
  for (std::size_t i = 0; i < one.image.pixels.size(); ++i)
    EXPECT_TRUE((two.image.pixels[i] == one.image.pixels[i]).all());
}

// Over 200 images the stated variance of pixels equals the actual variance, with even and adaptive sampling. The mean
// is over 48 pixels and 3 channels of 200 x 3 degrees of freedom each. Values are far from normal and neighbours share
// paths, so the tolerance is a tenth. The lower bound of Film::estimate may add to the stated variance.
TEST(LightTracingRender, StatedVarianceMatchesActual) {
  const Scene scene = lit_room();
  RenderOptions options = options_of(0, 32);
  for (const bool adaptive : {false, true}) {
    options.adaptive = adaptive;
    constexpr int pictures = 200;
    std::vector<std::array<mc::Moments, 3>> pixels(48);
    double stated = 0, real = 0;
    for (int i = 0; i < pictures; ++i) {
      options.seed = std::uint64_t(i);
      const Image image = render::render(scene, options).image;
      for (std::size_t p = 0; p < pixels.size(); ++p)
        for (int c = 0; c < 3; ++c) pixels[p][std::size_t(c)].add(double(image.pixels[p][c]));
      for (const Spectrum& v : image.variance) stated += double(v.sum()) / pictures;
    }
    for (const auto& pixel : pixels)
      for (const mc::Moments& m : pixel) real += m.variance();
    EXPECT_GT(stated, 0.9 * real) << adaptive;
    EXPECT_LT(stated, 1.3 * real) << adaptive;
  }
}

// A floor of albedo 1/2 under a slab of glass, in parallel light from above: light that only light paths find. A slab
// of index n transmits 2 n / (n^2 + 1), so that the radiance of the floor is 6/13.
Scene floor_under_glass(double fov, const Vec3d& target) {
  SceneBuilder builder;
  const BsdfId white = builder.add(Lambert(Spectrum::Constant(Float(0.5)))), glass = builder.add(Dielectric(1.5));
  builder.add(Light(DirectionalLight(Vec3d(0, -1, 0), Spectrum::Constant(Float(mc::pi<double>)))));
  builder.add(TriangleMesh::rectangle(Transform::rotate(Vec3d::UnitX(), -90) * Transform::scale({20, 20, 1})), {white});
  builder.add(TriangleMesh::box(Transform::translate({0, 1, 0}) * Transform::scale({2, 0.2, 2})), {glass});
  builder.set(ThinLens(Transform::look_at({5, 0.6, 0}, target, {0, 1, 0}), {.fov = fov}));
  return builder.build();
}

RenderResult rendered(const Scene& scene, int side, int spp, std::uint64_t seed) {
  RenderOptions options;
  options.width = options.height = side;
  options.spp = spp;
  options.seed = seed;
  return render::render(scene, options);
}

TEST(LightTracingRender, FewPathsInANarrowView_ErrorIsUnknown) {
  const Vec3d floor(0, 0, 0), sky(6, 0.6, 0);
  const Scene narrow = floor_under_glass(0.3, floor), narrowest = floor_under_glass(0.05, floor);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const RenderResult few = rendered(narrow, 64, 64, seed); // some light paths arrive, each in a pixel of its own
    EXPECT_TRUE(std::isinf(few.relative_error) && std::isinf(few.worst_error)) << few.relative_error;
    const RenderResult fewer = rendered(narrowest, 2, 20'000, seed); // hardly any arrives
    EXPECT_TRUE(std::isinf(fewer.relative_error)) << fewer.relative_error;
  }
  const RenderResult wide = rendered(floor_under_glass(10, floor), 16, 256, 1);
  EXPECT_LT(wide.relative_error, 0.2);
  EXPECT_NEAR(wide.image.at(8, 8)[0], 6.0 / 13, 6 * std::sqrt(double(wide.image.variance[8 * 16 + 8][0])));
  // Light paths reach no pixel whose camera paths leave the scene.
  EXPECT_EQ(rendered(floor_under_glass(0.3, sky), 8, 64, 1).relative_error, 0);
}

} // namespace
