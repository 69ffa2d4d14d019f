#include <render/scene/builder.h>
#include <render/tile_renderer.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Scene floor_under_the_sky() {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum(1, 2, 3))));
  builder.add(Sphere(Vec3d(0, -1001, -3), 1000), {builder.add(Lambert())});
  builder.add(Sphere(Vec3d(0, 0, -3), 1), {builder.add(Lambert())});
  return builder.build();
}

// Renders the tiles that begin at row y into a film, in two parts that meet between tiles.
RenderStats render_row(const TileRenderer& renderer, int y, const std::vector<std::uint32_t>& from,
                       const std::vector<std::uint32_t>& to, Film& film) {
  RenderStats stats;
  const std::size_t middle = 2 - std::size_t(renderer.tiling().x);
  for (const auto& [begin, end] : {std::pair(std::size_t{0}, middle), std::pair(middle, from.size())}) {
    FilmBlock block(film.width(), film.height(), film.sets());
    stats.merge(renderer.render_row(y, int(begin), std::span(from).subspan(begin, end - begin),
                                    std::span(to).subspan(begin, end - begin), block));
    film.add(block);
  }
  return stats;
}

// Samples in several calls equal samples in one call. Tiles that the film cuts belong to its first row.
TEST(TileRenderer, SplitCallsMatchOneCall) {
  const Scene scene = floor_under_the_sky();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    const TileRenderer renderer(scene, {}, {sampler, 5, 4}, {7, 7, {1, 1, 5, 4}});
    Film whole(5, 4, 3), parts(5, 4, 3);
    const std::vector<std::uint32_t> none(5, 0), some(5, 7), all(5, 40);
    RenderStats one, two;
    for (const int y : {0, 1, 2, 3}) {
      EXPECT_EQ(renderer.starts_tile_row(y), y != 2);
      one.merge(render_row(renderer, y, none, all, whole));
      two.merge(render_row(renderer, y, none, some, parts));
    }
    for (const int y : {3, 2, 1, 0}) two.merge(render_row(renderer, y, some, all, parts));
    EXPECT_EQ(one.samples, 5u * 4 * 40);
    EXPECT_EQ(two.samples, one.samples);
    EXPECT_EQ(one.rays, two.rays);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) {
        const PixelEstimate a = whole.estimate(x, y), b = parts.estimate(x, y);
        EXPECT_EQ(a.samples, 40u);
        EXPECT_GT(whole.rays(x, y), 0u);
        // The sums have the same terms in another order.
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(a.mean[c], b.mean[c], 1e-12) << name(sampler);
          EXPECT_NEAR(a.variance[c], b.variance[c], 1e-12) << name(sampler);
        }
      }
  }
}

// A sky that is too bright for floats makes the samples of all pixels of a tile invalid, and each is counted.
TEST(TileRenderer, CountsInvalidSamples) {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum::Constant(std::numeric_limits<Float>::max()))));
  builder.add(Sphere(Vec3d(0, 0, -3), 1), {builder.add(Lambert(Spectrum::Constant(Float(0.9))))});
  builder.add(Sphere(Vec3d(0, 0, -3), 1.5, true), {builder.add(Lambert(Spectrum::Constant(Float(0.9))))});
  const Scene scene = builder.build();
  const TileRenderer renderer(scene, {.strategy = strategy_from("nee")}, {PixelSampler::sobol, 5, 4},
                              {2, 2, {0, 0, 2, 2}});
  Film film(2, 2, 2);
  const RenderStats stats = render_row(renderer, 0, {0, 0}, {8, 8}, film);
  EXPECT_EQ(stats.samples, 32u);
  std::uint64_t valid = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) valid += film.estimate(x, y).samples;
  EXPECT_EQ(valid + stats.invalid, 32u);
}

} // namespace
