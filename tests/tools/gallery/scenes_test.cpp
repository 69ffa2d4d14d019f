#include <gallery/scenes.h>

#include <render/io/mitsuba/mitsuba.h>
#include <render/render.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(GalleryScenes, NamesAreUniqueAndHaveAFile) {
  std::set<std::string_view> names;
  for (const carlo::GalleryScene& scene : carlo::gallery()) {
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    EXPECT_EQ(&carlo::gallery_scene(scene.name), &scene);
    EXPECT_TRUE(fs::exists(carlo::scene_file(scene))) << scene.name;
    EXPECT_FALSE(scene.title.empty() || scene.source.empty()) << scene.name;
  }
}

TEST(GalleryScenes, EachFileIsListedAndCitesItsSource) {
  std::set<std::string> known;
  for (const carlo::GalleryScene& scene : carlo::gallery())
    known.insert(fs::path(carlo::scene_file(scene)).filename().string());
  for (const auto& entry : fs::directory_iterator(MC_SOURCE_DIR "/librender/scenes")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
    const std::string text = mc::read_file(entry.path().string());
    EXPECT_LT(text.find("<!--"), text.find("<scene")) << entry.path() << " begins with a comment that names its source";
  }
}

// The book's pair of pictures: random samples, and equally many samples in the strata of each pixel. The strata are
// split into the number of sets that a render keeps.
TEST(GalleryScenes, StratifiedPixelsUseTheDocumentedSampler) {
  const carlo::GalleryScene &boxes = carlo::gallery_scene("book3-pixels-stratified"),
                            &chance = carlo::gallery_scene("book3-pixels-random");
  EXPECT_EQ(boxes.spp, chance.spp);
  EXPECT_EQ(boxes.file, chance.file);
  render::RenderOptions options;
  options.width = options.height = options.max_depth = 1;
  options.spp = boxes.spp;
  options.sampler = render::sampler_from(boxes.sampler);
  EXPECT_EQ(options.sampler, render::PixelSampler::stratified);
  const auto sets = render::render(render::read_mitsuba(carlo::scene_file(boxes)).scene, options).estimates;
  EXPECT_EQ(sets, 2u) << "twice";
  EXPECT_EQ(boxes.title, fmt::format("Cornell box, {} samples per pixel, stratified in {} boxes", boxes.spp,
                                     static_cast<unsigned>(boxes.spp) / sets));
}

// Every scene file has a row in the committed table of trades; bench/scene_trades.py measures it.
TEST(GalleryScenes, EachFileHasTradeData) {
  const std::string trades = mc::read_file(MC_SOURCE_DIR "/notebooks-data/trade/scenes.csv");
  for (const carlo::GalleryScene& scene : carlo::gallery()) {
    const std::string file = fs::path(carlo::scene_file(scene)).stem().string();
    EXPECT_NE(trades.find("\n" + file + ","), std::string::npos) << file;
  }
}

TEST(GalleryScenes, UnknownNameSuggestsTheNearest) {
  EXPECT_THAT(support::error_of([] { carlo::gallery_scene("book3-cornel-glass"); }),
              HasSubstr("did you mean 'book3-cornell-glass'"));
  EXPECT_THAT(support::error_of([] { carlo::gallery_scene(""); }), HasSubstr("carlo gallery --list"));
}

} // namespace
