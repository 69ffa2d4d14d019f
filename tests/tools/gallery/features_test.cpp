#include <gallery/features.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <set>

namespace {

TEST(GalleryFeatures, AreReadFromTheSceneFile) {
  const std::vector<carlo::Feature> features = carlo::features_of(carlo::gallery_scene("smallpt"));
  EXPECT_THAT(features, testing::ElementsAre("integrator path", "sensor perspective", "film", "rfilter subpixeltent",
                                             "sampler", "bsdf diffuse", "bsdf conductor", "bsdf dielectric",
                                             "bsdf twosided", "shape sphere", "emitter area", "strategy mis+lt"));
}

TEST(GalleryFeatures, AreEachUsedByAScene) {
  std::set<carlo::Feature> required;
  for (const carlo::GalleryScene& scene : carlo::gallery())
    for (const carlo::Feature& f : carlo::features_of(scene)) required.insert(f);
  for (const carlo::Feature& f : carlo::all_features()) EXPECT_TRUE(required.contains(f)) << f;
  EXPECT_GT(required.size(), 30u);
}

TEST(GalleryFeatures, TableIsUpToDate) {
  EXPECT_EQ(mc::read_file(MC_SOURCE_DIR "/librender/scenes/GALLERY.md"), carlo::gallery_text())
      << "run: carlo gallery --table > librender/scenes/GALLERY.md";
}

} // namespace
