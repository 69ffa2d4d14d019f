#pragma once
/// The gallery: the named scenes of carlo.

#include <render/film/tone_mapping.h>

#include <span>
#include <string>
#include <string_view>

namespace carlo {

/// A scene file with render settings that the file does not contain.
struct GalleryScene {
  std::string_view name; ///< name for carlo gallery and carlo render
  std::string_view title;
  std::string_view source;        ///< book, course or program that the scene comes from
  std::string_view file = {};     ///< without .xml, in the folder of the scenes; empty: same as the name
  std::string_view strategy = {}; ///< empty: the default of carlo render
  std::string_view sampler = {};  ///< empty: the default of carlo render
  double exposure = 0;            ///< exposure of its PNG [stops]
  int spp = 0;                    ///< samples per pixel; 0: the value in the file
  render::ToneCurve tone = render::ToneCurve::clamp;
};

/// All scenes, grouped by source in the order of the documentation.
std::span<const GalleryScene> gallery();

/// The scene with this name. Throws Error that suggests the nearest name if there is none.
const GalleryScene& gallery_scene(std::string_view name);

/// Tone curve and exposure of its PNG.
inline render::ToneMapping tone_of(const GalleryScene& scene) { return {scene.tone, scene.exposure}; }

/// The path of its file: among the installed data, or in the source tree for a carlo in its build tree.
///   throws : Error that names both places if the scenes are in neither.
std::string scene_file(const GalleryScene& scene);

} // namespace carlo
