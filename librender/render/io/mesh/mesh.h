#pragma once
/// What the readers of mesh files have in common.

#include <render/core/transform.h>
#include <render/shape/triangle_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace render {

/// A mesh as a file holds it. Normals and texture coordinates: one for each position, or none. Where all corners of a
/// triangle have the normal 0, it is flat.
struct MeshFile {
  std::vector<Vec3d> positions, normals;
  std::vector<mc::Vec2<float>> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::string missing_uv_reason; ///< why there are no texture coordinates: "the face of line 7 has none"
  std::size_t meshes = 1;        ///< in the file, of which this is one
};

/// The shape of a mesh file under `to_world`, its triangles turned to the side of the file's normals; without these a
/// mirroring transform keeps theirs on their side.
///   flat   : without normals; else those of the file, or where it has none the mean of the faces about each vertex, by
///            their angles there [ThuermerWuethrich98]
///   throws : Error for what TriangleMesh refuses, and where no triangle has an area
TriangleMesh to_shape(const MeshFile& file, const Transform& to_world, bool flat = false);

/// The mesh without its normals, for to_shape to make smooth ones, its vertices shared only where faces meet under
/// `to_world` at less than an angle: what is at one position and texture coordinate is one vertex for the faces that
/// turn away by less than that from the first of them, and so on for the others.
///   throws : Error unless the angle lies in [0, 180]
///   Source : Mitsuba 0.6, maxSmoothAngle
MeshFile split_at_edges(const MeshFile& file, const Transform& to_world, double degrees);

/// Throws Error, naming the first, where a vertex or a normal is not finite or a triangle names a vertex that is not
/// there.
void require_valid_mesh(const MeshFile& file);

/// All faces of a Wavefront OBJ file as one mesh, polygons cut into triangles; materials are ignored. Faces without
/// normals are flat where others have them; where none has, groups and materials share no vertices. Texture coordinates
/// count where all faces have them.
///   throws : Error that names file and line for a missing or broken file, an index out of range, a vertex that is not
///            finite
MeshFile read_obj(const std::string& path);

/// Stanford's PLY, ascii or binary of either byte order: the elements vertex (x, y, z, and where it has them nx, ny, nz
/// and u, v or s, t) and face (vertex_indices or vertex_index), polygons cut into triangles; what else it holds is left
/// out.
///   throws : Error that names file and place for a missing or broken file, counts that its bytes cannot hold, an index
///            out of range, a vertex that is not finite
MeshFile read_ply(const std::string& path);

/// Mesh number `index` of a file in Mitsuba's serialized format, versions 3 and 4.
///   throws : Error that names the file for a missing or broken one, counts that its bytes cannot hold, an index out of
///            range, a vertex that is not finite
MeshFile read_serialized(const std::string& path, int index);

} // namespace render
