#pragma once
/// The gallery: the scenes that carlo knows by name.

#include <render/film/tone_mapping.h>

#include <span>
#include <string>
#include <string_view>

namespace carlo {

/// A scene file, and how it is rendered where its source says more than the file does.
struct GalleryScene {
  std::string_view name; ///< as carlo gallery and carlo render take it
  std::string_view title;
  std::string_view source;        ///< what it was learned from
  std::string_view file = {};     ///< without .xml, in the folder of the scenes; empty: its name
  std::string_view strategy = {}; ///< empty: carlo render's
  std::string_view sampler = {};  ///< empty: carlo render's
  double exposure = 0;            ///< of its PNG [stops]
  int spp = 0;                    ///< samples per pixel; 0: the file's
  render::ToneCurve tone = render::ToneCurve::clamp;
};

/// All of them, by source in the order of the text.
std::span<const GalleryScene> gallery();

/// Throws Error, naming the nearest, for an unknown name.
const GalleryScene& gallery_scene(std::string_view name);

/// How its PNG is made.
inline render::ToneMapping tone_of(const GalleryScene& scene) { return {scene.tone, scene.exposure}; }

/// The path of its file: of an installed carlo beside its other data, of one in its build tree in the project.
///   throws : Error that names both places where the scenes are at neither
std::string scene_file(const GalleryScene& scene);

} // namespace carlo
