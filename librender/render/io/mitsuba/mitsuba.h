#pragma once
/// Scenes in Mitsuba's XML format, versions 0.4 to 0.6.

#include <render/io/types.h>

#include <map>
#include <string>
#include <string_view>

namespace render {

/// Whose defaults hold where a scene leaves a parameter out and the two differ.
enum class Dialect { mitsuba, lajolla };
/// Throws Error, naming the nearest, for an unknown name.
Dialect dialect_from(std::string_view name);

/// Values of $names, which go before the scene's own defaults.
using Variables = std::map<std::string, std::string>;

/// Reads a scene file with its meshes. What it may say: plugins/reference.h.
///   throws : Error "scene.xml:14: ..." for broken XML, an unknown plugin or parameter (naming the nearest), a value
///            that cannot be read or used, a reference to nothing, a missing or broken mesh, an empty scene, variables
///            that it does not use
SceneFile read_mitsuba(const std::string& path, Dialect dialect = Dialect::mitsuba, const Variables& variables = {});

} // namespace render
