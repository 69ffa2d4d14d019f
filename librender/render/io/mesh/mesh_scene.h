#pragma once
/// A scene around a single mesh file.

#include <render/io/types.h>

#include <string>

namespace render {

/// Whether a path has the extension of a mesh: .obj, .ply or .serialized.
bool is_mesh_file(const std::string& path);

/// A scene with the mesh of a file (for .serialized its first mesh). The mesh is grey and stands on a grey ground under
/// the sky of [Shirley16]; y is up. The camera looks at the mesh from the front, right and above. The whole mesh is
/// visible at any aspect ratio.
///   materials : those of the .mtl files that an OBJ file names: Kd and map_Kd, under a coat with the colour Ks and the
///               exponent Ns; glass of the index Ni for illum 4, 6, 7 and 9; opacity d; emission Ke. A missing file is
///               a warning.
///   throws : the errors of the mesh readers; Error for a mesh without a triangle of positive area.
SceneFile read_mesh_scene(const std::string& path);

} // namespace render
