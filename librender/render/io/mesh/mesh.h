#pragma once
/// Readers of mesh files.

#include <render/core/transform.h>
#include <render/shape/triangle_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace render {

/// A mesh as stored in a file. Normals and texture coordinates are one per position, or none. A triangle is flat if the
/// normals at all its corners are 0.
struct MeshFile {
  std::vector<Vec3d> positions,                        ///< Positions of the vertices.
      normals;                                         ///< Normals, one per position or none.
  std::vector<mc::Vec2<float>> uvs;                    ///< Texture coordinates, one per position or none.
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< Indices of the vertices of each triangle.
  std::string missing_uv_reason; ///< Why there are no texture coordinates: "the face of line 7 has none".
  std::size_t meshes = 1;        ///< Number of meshes in the file.
  /// Material of each triangle as an index in material_names; empty if the file names no material.
  std::vector<std::uint32_t> triangle_materials = {};
  std::vector<std::string> material_names = {}; ///< Names of the materials; "" for triangles without one.
  std::vector<std::string> material_files = {}; ///< Names of the files that describe the materials.
};

/// The shape of a mesh file, transformed by `to_world`. Triangles are oriented to the side of the normals of the file.
/// Without normals in the file, a mirroring transform keeps the geometric normals on their side.
///   flat   : omits shading normals. Otherwise they are the normals of the file. If the file has none, they are the
///            means of the face normals at each vertex, weighted by the angles there [ThuermerWuethrich98].
///   throws : Error for meshes that TriangleMesh rejects, and if no triangle has a positive area.
TriangleMesh to_shape(const MeshFile& file, const Transform& to_world, bool flat = false);

/// The mesh without its normals, with vertices split at sharp edges, so that to_shape makes normals that are smooth
/// elsewhere. At each position and texture coordinate, faces share a vertex if their normals under `to_world` deviate
/// by less than `degrees` from the first face. The remaining faces form further vertices by the same rule.
///   throws : Error unless the angle lies in [0, 180].
///   Source : Mitsuba 0.6, maxSmoothAngle.
MeshFile split_at_edges(const MeshFile& file, const Transform& to_world, double degrees);

/// Throws Error for the first vertex or normal that is not finite, or the first triangle with an invalid vertex index.
void require_valid_mesh(const MeshFile& file);

/// The triangles of each material with their vertices, in the order of material_names.
std::vector<MeshFile> parts_of(const MeshFile& file);

/// Reads all faces of a Wavefront OBJ file as one mesh and splits polygons into triangles. If some
/// faces have normals, the others are flat. If none has, vertices are not shared across groups and materials. Texture
/// coordinates are kept only if all faces have them.
///   throws : Error with file and line for a missing or broken file, an index out of range, or a vertex that is not
///            finite.
MeshFile read_obj(const std::string& path);

/// Reads a Stanford PLY file, ASCII or binary of either byte order, and splits polygons into triangles. Reads the
/// element `vertex` (x, y, z; optionally nx, ny, nz and u, v or s, t) and the elements `face` and `tristrips`
/// (vertex_indices or vertex_index; -1 ends a strip). Ignores all other content.
///   throws : Error with file and place for a missing or broken file, counts too large for the size of the file, an
///            index out of range, or a vertex that is not finite.
MeshFile read_ply(const std::string& path);

/// Reads mesh number `index` of a file in the serialized format of Mitsuba, versions 3 and 4.
///   throws : Error with the file for a missing or broken file, counts too large for its size, an index out of range,
///            or a vertex that is not finite.
MeshFile read_serialized(const std::string& path, int index);

} // namespace render
