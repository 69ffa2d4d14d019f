#pragma once
/// Wavefront OBJ meshes.

#include <render/shape/triangle_mesh.h>

#include <string>

namespace render {

/// Reads all faces of an OBJ file as one mesh, polygons cut into triangles, vertices mapped by `to_world`; materials
/// are ignored, since the scene file gives them. face_normals: those of the vertices are left out.
///   throws : Error that names the file for a missing or broken file, an index out of range, a vertex that is not
///            finite
TriangleMesh read_obj(const std::string& path, const Transform& to_world, bool face_normals = false);

} // namespace render
