#include <render/renderer_choice.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace {

using namespace render;

constexpr ImageExtent extent{12, 12, {0, 0, 12, 12}};

// Under a sky, too, so that the numbers of branches matter in every pixel.
Scene floor_under_a_lamp() {
  SceneBuilder builder;
  builder.add(Light(ConstantBackground(Spectrum::Constant(Float(0.1)))));
  const BsdfId grey = builder.add(Lambert(Spectrum::Constant(Float(0.5))));
  builder.add(Sphere(Vec3d(0, -101, 0), 100), {grey});
  builder.add(Sphere(Vec3d(2, 1, 0), 0.4), {grey, Emission{Spectrum::Constant(10)}});
  builder.set(ThinLens(Transform::look_at({0, 3, 0}, {0, 0, 0}, {0, 0, 1}), {.fov = 30}));
  return builder.build();
}

RendererChoice choice_of(const Scene& scene, const RenderOptions& options) {
  return {scene, options, {PixelSampler::sobol, 5, 4}, extent, {}, nullptr};
}

Film rendered(const RendererChoice& choice, bool alternates) {
  Film film(12, 12, 2);
  const std::vector<std::uint32_t> from(12), to(12, 8);
  for (int y = 0; y < 12; ++y) {
    FilmBlock block(12, 12, 2);
    choice.render_row(y, 0, from, to, block, {}, alternates);
    film.add(block);
  }
  return film;
}

bool same_block(const Film& a, const Film& b, int column, int row) {
  bool same = true;
  for (int y = 4 * row; y < 4 * row + 4; ++y)
    for (int x = 4 * column; x < 4 * column + 4; ++x) same &= (a.estimate(x, y).mean == b.estimate(x, y).mean).all();
  return same;
}

TEST(RendererChoice, BlocksTakeTheRenderersInTurn) {
  const Scene scene = floor_under_a_lamp();
  RenderOptions one, two, tiles;
  one.branches = 1;
  two.branches = 2;
  tiles.tiles = true;
  const RendererChoice open = choice_of(scene, {});
  const std::array<Film, 3> alone = {rendered(choice_of(scene, two), true), rendered(choice_of(scene, one), true),
                                     rendered(choice_of(scene, tiles), true)};
  const Film all = rendered(open, true), first = rendered(open, false);
  int orders = 0;
  for (std::size_t start = 0; start < 3; ++start) {
    bool in_order = true;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        in_order &= same_block(all, alone[(start + std::size_t(row + column)) % 3], column, row);
    orders += in_order;
  }
  EXPECT_EQ(orders, 1);
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(same_block(first, alone[0], i % 3, i / 3)) << i;
}

// A pilot whose blocks of one renderer, every third diagonal of blocks, have less noise, or fewer rays.
TEST(RendererChoice, ChoosesTheLeastErrorAndCost) {
  const Scene scene = floor_under_a_lamp();
  const auto side = [&](int best, double noise, std::uint64_t rays) {
    Film pilot(12, 12, 2);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x) {
        const bool is_best = (x / 4 + y / 4) % 3 == best;
        for (const int set : {0, 1})
          pilot.add(x, y, set, Eigen::Array3d::Constant(8 * (1 + (set - 0.5) * (is_best ? noise : 0.1))), 8);
        pilot.record_samples(x, y, {}, is_best ? rays : 100);
      }
    RendererChoice choice = choice_of(scene, {});
    EXPECT_EQ(choice.tiling().side, 1);
    choice.choose(pilot);
    EXPECT_EQ(choice.noise_area(0.5), choice.tiling().side == 2 ? 4 : 1.5);
    return choice.tiling().side;
  };
  for (const auto& [noise, rays] : {std::pair(0.08, 100), std::pair(0.1, 70), std::pair(0.05, 300)}) {
    int tiles = 0;
    for (const int best : {0, 1, 2}) tiles += side(best, noise, std::uint64_t(rays)) == 2;
    EXPECT_EQ(tiles, 1) << noise << " " << rays;
  }
}

// A black pilot has no errors to compare.
TEST(RendererChoice, BlackPilot_TakesTheFirst) {
  const Scene scene = floor_under_a_lamp();
  Film black(12, 12, 2);
  for (int i = 0; i < 144; ++i)
    for (const int set : {0, 1}) black.add(i % 12, i / 12, set, Eigen::Array3d::Zero(), 8);
  RendererChoice choice = choice_of(scene, {});
  choice.choose(black);
  EXPECT_EQ(choice.tiling().side, 1);
  RenderOptions two;
  two.branches = 2;
  EXPECT_TRUE(same_block(rendered(choice, true), rendered(choice_of(scene, two), true), 1, 1));
}

TEST(RendererChoice, OptionsLeaveNothingOpen) {
  const Scene scene = floor_under_a_lamp();
  RenderOptions even, tiles;
  even.adaptive = false;
  tiles.tiles = true;
  EXPECT_EQ(choice_of(scene, even).any_tiling().side, 1);
  EXPECT_EQ(choice_of(scene, even).noise_area(1), 1);
  EXPECT_EQ(choice_of(scene, tiles).tiling().side, 2);
  EXPECT_EQ(choice_of(scene, tiles).noise_area(0), 4);
}

} // namespace
