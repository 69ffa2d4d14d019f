#include <gallery/comparison.h>
#include <gallery/scenes.h>

#include <render/io/mitsuba/mitsuba.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace {

// Allows five standard errors of the difference of two nearly normal means: one failure in two million for each of four
// strategies.
TEST(GalleryComparison, StrategiesAgreeUnlessTheyMissLight) {
  const auto file = render::read_mitsuba(carlo::scene_file(carlo::gallery_scene("book3-cornell-white")));
  render::RenderOptions settings;
  settings.width = settings.height = 600;
  settings.seed = 3;
  const std::vector<carlo::StrategyResult> all = carlo::compare_strategies(file.scene, settings, 16, 64);
  ASSERT_EQ(all.size(), complete_strategies(file.scene).size());
  const carlo::StrategyResult* best = carlo::most_precise(all);
  ASSERT_TRUE(best);
  for (const carlo::StrategyResult& s : all) {
    const double error = std::hypot(s.mean.std_error, best->mean.std_error),
                 z = (s.mean.value - best->mean.value) / error;
    if (s.name == "light") EXPECT_LT(z, -5) << s.mean.value << " of " << best->mean.value;
    else EXPECT_LE(std::abs(z), 5) << s.name << ": " << s.mean.value << " of " << best->mean.value;
    EXPECT_GT(s.work, 0) << s.name;
  }
}

TEST(GalleryComparison, StopsWhenCancelled) {
  const auto file = render::read_mitsuba(carlo::scene_file(carlo::gallery_scene("book1-diffuse")));
  const std::atomic<bool> cancel = true;
  render::RenderOptions settings;
  settings.cancel = &cancel;
  EXPECT_TRUE(carlo::compare_strategies(file.scene, settings, 16, 64).empty());
  EXPECT_EQ(carlo::most_precise({}), nullptr);
}

} // namespace
