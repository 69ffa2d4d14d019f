#pragma once
/// Results of the scene readers.

#include <render/film/image.h>
#include <render/scene/scene.h>

#include <set>
#include <string>
#include <vector>

namespace render {

/// Render settings that a scene file contains.
struct RenderDefaults {
  int width = 256,         ///< Width of the image [pixels].
      height = 256;        ///< Height of the image [pixels].
  int spp = 64;            ///< Samples per pixel.
  int max_depth = -1;      ///< Longest path in edges; -1: no limit.
  Aov aov = Aov::radiance; ///< Output of the integrator.
};

/// A scene as read from a file.
struct SceneFile {
  Scene scene;                            ///< The scene.
  RenderDefaults defaults;                ///< Its render settings.
  Vec3d origin = Vec3d::Zero();           ///< Point of the file that becomes the origin of the scene.
  std::vector<std::string> warnings = {}; ///< "scene.xml:14: ...": differences from the image of Mitsuba.
  std::set<std::string> files = {};       ///< All files read: the scene, included files, meshes, images.
  /// Names of the scene's surfaces for messages: "rectangle 'slab' (scene.xml:14)". Empty for meshes.
  std::vector<std::string> surface_names = {};
  std::vector<std::string> light_names = {}; ///< The same for its lights.
};

} // namespace render
