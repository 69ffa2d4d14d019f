#include <gallery/label.h>
#include <gallery/strategy_strip.h>

#include <render/scene/builder.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <atomic>

namespace {

using testing::HasSubstr, testing::Not;

render::Scene lit_floor(bool with_point) {
  render::SceneBuilder builder;
  const render::BsdfId gray = builder.add(render::Lambert());
  builder.add(render::TriangleMesh::rectangle(render::Transform::translate({0, 0, 3})), {gray});
  builder.add(render::Sphere({0, 0, -2}, 1.5), {gray, render::Emission{}});
  if (with_point) builder.add(render::Light(render::PointLight({0, 1, 0}, render::Spectrum::Ones())));
  return builder.build();
}

render::RenderOptions tiny() {
  render::RenderOptions settings;
  settings.width = 4;
  settings.height = 3;
  settings.max_depth = 2;
  return settings;
}

// Pixels of the sheet that are as white as text, in the columns [left, right) and rows [top, bottom).
int white(const render::Image& sheet, int left, int right, int top, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) count += (sheet.at(x, y) == 1).all() ? 1 : 0;
  return count;
}

// Seven strategies, or the two that sample a point light; six pictures each, in cells as wide as "1024 spp".
TEST(StrategyStrip, HasALabelledRowForEachStrategy) {
  constexpr int gap = 4, line = 20, cell = 80;
  const int left = gap + carlo::label_width("hemisphere") + gap;
  const render::Image all = carlo::strategy_strip(lit_floor(false), tiny(), {});
  EXPECT_EQ(all.width, left + 6 * (cell + gap));
  EXPECT_EQ(all.height, gap + line + 7 * (line + gap));
  for (int column = 0; column < 6; ++column) {
    const int x = left + column * (cell + gap);
    EXPECT_GT(white(all, x, x + cell, 0, gap + line), 50) << column;
  }
  for (int row = 0; row < 7; ++row) {
    const int y = gap + line + row * (line + gap);
    EXPECT_GT(white(all, 0, left, y, y + line), 30) << row;
  }
  const render::Image two = carlo::strategy_strip(lit_floor(true), tiny(), {});
  EXPECT_EQ(two.height, gap + line + 2 * (line + gap));
  render::RenderOptions settings = tiny();
  const std::atomic<bool> cancel = true;
  settings.cancel = &cancel;
  EXPECT_EQ(carlo::strategy_strip(lit_floor(false), settings, {}).width, 0);
}

TEST(StrategyStrip, TableComparesEqualSamplesAndEqualTime) {
  const render::Scene scene = lit_floor(false);
  render::RenderOptions settings = tiny();
  settings.max_depth = 3;
  const auto samples = carlo::compare_strategies(scene, settings, 4, 64);
  const auto time = carlo::compare_strategies_for_time(scene, settings, 0.005);
  ASSERT_EQ(samples.size(), 7u);
  ASSERT_EQ(time.size(), 7u);
  for (const auto& s : samples) EXPECT_NEAR(s.spp, 64, 0.5) << s.name; // adaptive rates are rounded to whole samples
  for (const auto& t : time) EXPECT_GE(t.spp, 2) << t.name;            // a variance needs two
  const std::string text = carlo::strategy_table(samples, time);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 8);
  for (const auto& s : samples) EXPECT_THAT(text, HasSubstr("\n" + std::string(s.name) + " "));
  EXPECT_THAT(text, HasSubstr("100.00 +- "));
  EXPECT_THAT(text, HasSubstr("misses light"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  for (const auto& s : carlo::compare_strategies(scene, tiny(), 4, 4)) // paths of two edges end at the lamp
    EXPECT_FALSE(s.misses_light) << s.name;
  // A strategy that has found no light is not precise, however small its variance.
  auto blind = samples;
  blind[0].mean = {0, 0, 99, 100};
  blind[0].relative_error = blind[0].work = 0;
  EXPECT_THAT(carlo::strategy_table(blind, time), HasSubstr("100.00 +- "));
  EXPECT_THAT(support::error_of([&] { carlo::strategy_table(samples, {}); }), HasSubstr("7 with the same samples"));
}

TEST(StrategyStrip, SmallPicturesKeepTheirSize) {
  render::RenderOptions settings;
  settings.width = 600;
  settings.height = 300;
  EXPECT_EQ(carlo::shrink_to_fit(settings, 96).width, 96);
  EXPECT_EQ(carlo::shrink_to_fit(settings, 96).height, 48);
  EXPECT_EQ(carlo::shrink_to_fit(settings, 1000).width, 600);
}

} // namespace
