// Renders that are cancelled in their first round.

#include <render/light_tracing_pass.h>
#include <render/render.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace render;

constexpr std::uint64_t rows_before = 12; // number of rows before the cancellation

RenderOptions small() {
  RenderOptions options;
  options.width = 9;
  options.height = 64;
  options.spp = 1000;
  return options;
}

// Cancels the render after the samples of `rows_before` rows.
RenderResult interrupted(const Scene& scene, RenderOptions options) {
  const auto width = static_cast<std::uint64_t>(options.crop ? options.crop->width : options.width),
             per_pixel = static_cast<std::uint64_t>(std::min(options.spp, 2));
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  options.progress = [&](const Progress& p) {
    if (p.samples >= rows_before * width * per_pixel) cancel = true;
  };
  return render::render(scene, options);
}

// While one thread waits for a processor in the first rows, the other may render all rows behind them: the samples of a
// row count once the rows before it are rendered.
bool is_ahead(const RenderResult& cut) { return cut.image.height - cut.missing_rows > int(2 * rows_before); }

/// A floor under a small lamp fills the image, so that all rows differ.
Scene lit_floor() {
  SceneBuilder builder;
  const BsdfId grey = builder.add(Lambert(Spectrum::Constant(Float(0.5))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {grey});
  builder.add(Sphere(Vec3d(2, 1, 0), 0.4), {grey, Emission{Spectrum::Constant(10)}});
  builder.set(ThinLens(Transform::look_at({0, 3, 0}, {0, 0, 0}, {0, 0, 1}), {.fov_axis = FovAxis::y, .fov = 30}));
  return builder.build();
}

// Rendered rows have the same bits as a complete image of two samples per pixel. Missing rows repeat the nearest one,
// which is never far.
TEST(InterruptedRender, RepeatsTheNearestRow) {
  const Scene scene = lit_floor();
  RenderOptions plain = small(), tiles = plain, adaptive = plain, crop = plain;
  tiles.tiles = true;
  adaptive.adaptive = true;
  crop.height = 90;
  crop.crop = Crop{2, 13, 5, 64};
  RenderOptions tiles_of_crop = crop;
  tiles_of_crop.tiles = true;
  const std::pair<const char*, RenderOptions> cases[] = {
      {"plain", plain}, {"tiles", tiles}, {"adaptive", adaptive}, {"crop", crop}, {"tiles of a crop", tiles_of_crop}};
  for (const auto& [name, asked] : cases)
    for (const int threads : {1, 2}) {
      RenderOptions options = asked;
      options.threads = threads;
      const RenderResult cut = interrupted(scene, options);
      if (threads > 1 && is_ahead(cut)) continue;
      EXPECT_TRUE(cut.partial) << name;
      EXPECT_EQ(cut.estimates, 0u) << name;
      EXPECT_TRUE(cut.image.variance.empty()) << name;
      options.spp = 2;
      options.adaptive = false;
      const Image whole = render::render(scene, options).image;
      const auto is_row = [&](const Image& image, int y, int at) {
        for (int x = 0; x < whole.width; ++x)
          if (!(cut.image.at(x, y) == image.at(x, at)).all()) return false;
        return true;
      };
      std::vector<int> rendered;
      for (int y = 0; y < 64; ++y)
        if (is_row(whole, y, y)) rendered.push_back(y);
      ASSERT_EQ(static_cast<int>(rendered.size()), 64 - cut.missing_rows) << name;
      ASSERT_GE(rendered.size(), rows_before) << name;
      ASSERT_LE(rendered.size(), 2 * rows_before) << name;
      for (int y = 0; y < 64; ++y) {
        const auto distance = [&](int r) { return std::abs(r - y); };
        const int nearest = *std::min_element(rendered.begin(), rendered.end(),
                                              [&](int a, int b) { return distance(a) < distance(b); });
        EXPECT_LE(distance(nearest), 16) << name << " " << y;
        EXPECT_TRUE(is_row(cut.image, y, nearest)) << name << " " << y;
      }
    }
}

// A large image has many light paths, and the first row waits for a few of them only.
TEST(InterruptedRender, FirstRowsPrecedeMostLightPaths) {
  SceneBuilder builder;
  const BsdfId grey = builder.add(Lambert(Spectrum::Constant(Float(0.5))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {grey});
  builder.add(Sphere(Vec3d(0, 0, 0), 0.5), {builder.add(Dielectric())});
  builder.add(Sphere(Vec3d(2, 1, 0), 0.4), {grey, Emission{Spectrum::Constant(10)}});
  builder.set(ThinLens(Transform::look_at({0, 3, 0}, {0, 0, 0}, {0, 0, 1}), {.fov = 30}));
  const Scene scene = builder.build();
  RenderOptions options;
  options.width = options.height = 1024;
  options.spp = 2;
  options.threads = 1;
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  options.progress = [&](const Progress&) { cancel = true; };
  const RenderResult cut = render::render(scene, options);
  EXPECT_EQ(cut.missing_rows, 1023);
  EXPECT_GE(cut.rays, LightTracingPass::batch_size);
  EXPECT_LE(cut.rays, 2 * 1024 * 1024 / 8); // each light path of the round takes at least one ray
}

// Splats of missing rows are absent. With constant light this must not show.
TEST(InterruptedRender, SplatFilter_KeepsBrightness) {
  SceneBuilder builder;
  const Spectrum sky(Float(0.1), Float(0.2), Float(0.3));
  builder.add(Light(ConstantBackground(sky)));
  builder.set(Filter(GaussianFilter()));
  builder.set(ThinLens(Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), {}));
  const Scene scene = builder.build();
  RenderOptions options = small();
  options.splat = true;
  for (const int threads : {1, 2}) {
    options.threads = threads;
    const RenderResult cut = interrupted(scene, options);
    if (threads > 1 && is_ahead(cut)) continue;
    EXPECT_GT(cut.missing_rows, 0);
    EXPECT_LT(cut.missing_rows, 64);
    EXPECT_TRUE(cut.image.variance.empty());
    for (const Spectrum& p : cut.image.pixels) EXPECT_LE(double((p - sky).abs().maxCoeff()), 1e-6);
  }
}

} // namespace
