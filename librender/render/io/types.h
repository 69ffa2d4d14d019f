#pragma once
/// What the readers of scenes give.

#include <render/film/image.h>
#include <render/scene/scene.h>

#include <set>
#include <string>
#include <vector>

namespace render {

/// How a scene file asks to be rendered.
struct RenderDefaults {
  int width = 256, height = 256;
  int spp = 64;
  int max_depth = -1; ///< longest path in edges; -1: no limit
  Aov aov = Aov::radiance;
};

struct SceneFile {
  Scene scene;
  RenderDefaults defaults;
  Vec3d origin = Vec3d::Zero();           ///< the point of the file that is the origin of the scene
  std::vector<std::string> warnings = {}; ///< "scene.xml:14: ...": where the picture is not what Mitsuba makes of it
  std::set<std::string> files = {};       ///< that were read: the scene's own, what it includes, meshes, pictures
};

} // namespace render
