#pragma once
/// Scenes in Mitsuba's XML format, versions 0.4 to 0.6.

#include <render/film/image.h>
#include <render/scene/scene.h>

#include <map>
#include <string>
#include <vector>

namespace render {

/// How a scene file asks to be rendered.
struct RenderDefaults {
  int width = 256, height = 256;
  int spp = 64;
  int max_depth = -1; ///< longest path in edges; -1: no limit
  Shown shown = Shown::radiance;
};

struct SceneFile {
  Scene scene;
  RenderDefaults defaults;
  Vec3d origin = Vec3d::Zero();           ///< the point of the file that is the origin of the scene
  std::vector<std::string> warnings = {}; ///< "scene.xml:14: ...": where the picture is not what Mitsuba makes of it
};

/// Whose defaults hold where a scene leaves a parameter out and the two differ.
enum class Dialect { mitsuba, lajolla };
/// Throws Error, naming the nearest, for an unknown name.
Dialect dialect_from(std::string_view name);

/// Values of $names, which go before the scene's own defaults.
using Variables = std::map<std::string, std::string>;

/// Reads a scene file with its meshes. What it may say: mitsuba/reference.h.
///   throws : Error "scene.xml:14: ..." for broken XML, an unknown plugin or parameter (naming the nearest), a value
///            that cannot be read or used, a reference to nothing, a missing or broken mesh, an empty scene, variables
///            that it does not use
SceneFile read_mitsuba(const std::string& path, Dialect dialect = Dialect::mitsuba, const Variables& variables = {});

} // namespace render
