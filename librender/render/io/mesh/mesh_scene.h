#pragma once
/// A scene around a single mesh file.

#include <render/io/types.h>

#include <string>

namespace render {

/// Whether a path has the extension of a mesh: .obj, .ply or .serialized.
bool is_mesh_file(const std::string& path);

/// A scene with the mesh of a file (for .serialized its first mesh). The mesh stands on a grey ground under the sky of
/// [Shirley16]; y is up. The camera looks at it from the front (+z), right (+x) and above. The whole mesh is in the
/// picture at any aspect ratio.
///   materials : grey, or those of the .mtl files that an OBJ file names: Kd and map_Kd, if Ks > 0 under a coat of this
///               colour with the exponent Ns; glass of the index Ni for illum 4, 6, 7 and 9; the opacity d of what
///               neither is glass nor emits; emission Ke. A missing .mtl file or picture is a warning.
///   throws    : the errors of the readers of meshes, materials and pictures; Error for a mesh without a triangle of
///               positive area, or of a size above 1e30.
SceneFile read_mesh_scene(const std::string& path);

} // namespace render
