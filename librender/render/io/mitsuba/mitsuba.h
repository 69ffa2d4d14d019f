#pragma once
/// Scenes in the XML format of Mitsuba, versions 0.4 to 0.6.

#include <render/io/types.h>

#include <map>
#include <string>
#include <string_view>

namespace render {

/// Renderer with the defaults to use for omitted parameters, where Mitsuba and lajolla differ.
enum class Dialect { mitsuba, lajolla };
/// The dialect with the given name. Throws Error with the most similar name for an unknown one.
Dialect dialect_from(std::string_view name);

/// Values of $names, which override the defaults of the scene.
using Variables = std::map<std::string, std::string>;

/// Reads a scene file with its meshes. plugins/reference.h documents the format.
///   throws : Error "scene.xml:14: ..." for broken XML, an unknown plugin or parameter (with the most similar name), or
///            an invalid value. Also for a reference to nothing, a missing or broken mesh, an empty scene, or variables
///            that the scene does not use.
SceneFile read_mitsuba(const std::string& path, Dialect dialect = Dialect::mitsuba, const Variables& variables = {});

} // namespace render
