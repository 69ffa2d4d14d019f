#include <render/pixel_renderer.h>

#include <render/scene/builder.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

Scene ball_under_the_sky() {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum(1, 2, 3))));
  builder.add(Sphere(Vec3d(0, 0, -3), 1), {builder.add(Lambert())});
  return builder.build();
}

// Renders a row from its first pixel on into a film.
RenderStats render_row(const PixelRenderer& renderer, int y, const std::vector<std::uint32_t>& from,
                       const std::vector<std::uint32_t>& to, Film& film) {
  FilmBlock block(film.width(), film.height(), film.sets());
  const RenderStats stats = renderer.render_row(y, 0, from, to, block);
  film.add(block);
  return stats;
}

// Samples in several calls equal samples in one call.
TEST(PixelRenderer, SplitCallsMatchOneCall) {
  const Scene scene = ball_under_the_sky();
  for (const PixelSampler sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
    const PixelRenderer renderer(scene, {}, {sampler, 5, 4}, {3, 2, {0, 0, 3, 2}});
    Film whole(3, 2, 4), parts(3, 2, 4);
    const std::vector<std::uint32_t> none = {0, 0, 0}, some = {1, 6, 19}, all = {40, 7, 19};
    const RenderStats one = render_row(renderer, 1, none, all, whole);
    RenderStats two = render_row(renderer, 1, none, some, parts);
    two.merge(render_row(renderer, 1, some, all, parts));
    EXPECT_EQ(one.samples, 66u);
    EXPECT_EQ(two.samples, 66u);
    EXPECT_EQ(one.rays, two.rays);
    EXPECT_EQ(whole.rays(0, 1) + whole.rays(1, 1) + whole.rays(2, 1), one.rays);
    for (int x = 0; x < 3; ++x) {
      const PixelEstimate a = whole.estimate(x, 1), b = parts.estimate(x, 1);
      EXPECT_EQ(a.samples, all[std::size_t(x)]);
      EXPECT_EQ(a.sets, 4);
      // The sums have the same terms in another order.
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a.mean[c], b.mean[c], 1e-12) << name(sampler);
        EXPECT_NEAR(a.variance[c], b.variance[c], 1e-12) << name(sampler);
      }
    }
    EXPECT_EQ(whole.estimate(0, 0).samples, 0u);
  }
}

// A row in parts equals the row in one piece, bit for bit.
TEST(PixelRenderer, PartsOfARowMatchTheRow) {
  const Scene scene = ball_under_the_sky();
  const PixelRenderer renderer(scene, {}, {PixelSampler::sobol, 5, 4}, {5, 2, {0, 0, 5, 2}});
  Film whole(5, 2, 2), parts(5, 2, 2);
  const std::vector<std::uint32_t> from(5, 1), to = {9, 8, 7, 6, 5};
  render_row(renderer, 0, from, to, whole);
  for (const auto& [begin, count] : {std::pair(0, 2), std::pair(2, 1), std::pair(3, 2)}) {
    FilmBlock block(5, 2, 2);
    renderer.render_row(0, begin, std::span(from).subspan(std::size_t(begin), std::size_t(count)),
                        std::span(to).subspan(std::size_t(begin), std::size_t(count)), block);
    parts.add(block);
  }
  for (int x = 0; x < 5; ++x) {
    EXPECT_TRUE((whole.estimate(x, 0).mean == parts.estimate(x, 0).mean).all());
    EXPECT_TRUE((whole.estimate(x, 0).variance == parts.estimate(x, 0).variance).all());
  }
}

TEST(RenderStats, KeepsTheFirstInvalidSampleInAnyOrder) {
  const InvalidSample late{0, 0, 2, 0}, early{5, 5, 1, 9};
  RenderStats a, b;
  a.add(late);
  b.add(early);
  a.merge(b);
  EXPECT_EQ(a.invalid, 2u);
  EXPECT_EQ(a.first_invalid.pass, 1u);
  a.add(late);
  EXPECT_EQ(a.first_invalid.x, 5);
}

// A camera in the middle of a ball shows a lamp. The ball's medium absorbs only along rays that start inside. Rays from
// a lens or a near plane that extends beyond the ball start outside.
TEST(PixelRenderer, CameraRaysStartInEnclosingMedium) {
  const auto seen = [](const LensOptions& lens, bool filled) {
    SceneBuilder builder;
    builder.add(TriangleMesh::rectangle(Transform::translate({0, 0, 9}) * Transform::rotate(Vec3d::UnitX(), 180) *
                                        Transform::scale(Vec3d::Constant(9))),
                {builder.add(Lambert()), Emission{}});
    SceneBuilder::SurfaceProperties cover{.bsdf = builder.add(Dielectric())};
    if (filled) cover.interior = HomogeneousMedium(Spectrum::Constant(1));
    builder.add(Sphere(Vec3d::Zero(), 1), cover);
    builder.set(ThinLens({}, lens));
    const Scene scene = builder.build();
    const PixelRenderer renderer(scene, {.max_depth = 1}, {PixelSampler::sobol, 5, 4}, {1, 1, {0, 0, 1, 1}});
    Film film(1, 1, 4);
    render_row(renderer, 0, {0}, {400}, film);
    return film.estimate(0, 0).mean[0];
  };
  EXPECT_EQ(seen({.fov = 10, .near = 1.5}, true), 1);
  const LensOptions wide = {.fov = 10, .radius = 2, .focus_distance = 9};
  EXPECT_EQ(seen(wide, true), seen(wide, false));
  EXPECT_NEAR(seen(wide, true), 0.75, 0.02);
}

} // namespace
