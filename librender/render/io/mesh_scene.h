#pragma once
/// A scene of a mesh alone.

#include <render/io/types.h>

#include <string>

namespace render {

/// Whether a path has the extension of a mesh: .obj, .ply or .serialized.
bool is_mesh_file(const std::string& path);

/// The mesh of a file (of .serialized its first), grey, on a grey ground under the sky of [Shirley16], y up. The camera
/// looks at it from the front, from the right and from above, and sees all of it at any size of the picture.
///   throws : what the readers of meshes throw; Error for a mesh without a triangle that has an area
SceneFile read_mesh_scene(const std::string& path);

} // namespace render
