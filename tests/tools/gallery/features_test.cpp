#include <gallery/features.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <set>

namespace {

TEST(GalleryFeatures, ASceneHasThoseOfItsFile) {
  const std::vector<carlo::Feature> features = carlo::features_of(carlo::gallery_scene("smallpt"));
  EXPECT_THAT(features, testing::ElementsAre("integrator path", "sensor perspective", "film", "rfilter subpixeltent",
                                             "sampler", "bsdf diffuse", "bsdf conductor", "bsdf dielectric",
                                             "shape sphere", "emitter area", "strategy mis"));
}

TEST(GalleryFeatures, TheTableIsUpToDate) {
  EXPECT_EQ(mc::read_file(MC_SOURCE_DIR "/librender/scenes/GALLERY.md"), carlo::gallery_text())
      << "run: carlo gallery --table > librender/scenes/GALLERY.md";
}

} // namespace
