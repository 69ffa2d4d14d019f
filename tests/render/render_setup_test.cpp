#include <render/film/film_block.h>
#include <render/film/sampling_plan.h>
#include <render/render_setup.h>
#include <render/scene/builder.h>

#include <mc/run/executor.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

// For each thread, the rows that may wait need as much as their blocks; never more than all rows.
TEST(RenderSetup, FilmMemoryCountsRowsThatWait) {
  const std::optional<SplatFilter> splat(std::in_place, Filter(GaussianFilter()));
  const int side = 2 * splat->reach() + 1;
  RenderOptions options;
  options.spp = 2;
  const Crop crop{0, 0, 300, 200};
  const auto memory = [&](int threads) {
    options.threads = threads;
    return film_memory(crop, options, false, splat);
  };
  const double row = crop.width * FilmBlock::bytes_per_pixel(2, side * side);
  EXPECT_DOUBLE_EQ(memory(2) - memory(1), double(mc::max_waiting_results(1)) * row);
  EXPECT_DOUBLE_EQ(memory(1000) - memory(1), double(200 - mc::max_waiting_results(1)) * row);
}

// Adaptive sampling plans at the end of the pilot, while there is no image.
TEST(RenderSetup, FilmMemoryCountsThePlan) {
  const Crop crop{0, 0, 300, 200};
  const auto memory = [&](int spp, bool adaptive) {
    RenderOptions options;
    options.spp = spp;
    options.adaptive = adaptive;
    return film_memory(crop, options, false, std::nullopt);
  };
  EXPECT_EQ(memory(16, true), memory(16, false));
  EXPECT_EQ(memory(17, true) - memory(17, false), 300 * 200 * (planning_bytes - 2 * double(sizeof(Spectrum))));
}

TEST(RenderSetup, SetsOfFewSamples) {
  RenderOptions options;
  options.spp = 7;
  EXPECT_EQ(sets_of(options), 2);
  options.spp = 1;
  EXPECT_EQ(sets_of(options), 1);
  options.seconds = 1;
  EXPECT_EQ(sets_of(options), 2);
}

} // namespace
