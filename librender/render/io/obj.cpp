#include <render/io/obj.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

#include <Eigen/LU>

#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>

namespace render {

namespace {

// The library reads what is not a number as 0: look at the vertex lines first.
void check_vertices(const std::string& text) {
  std::size_t line = 0, vertex = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (text.compare(begin, 2, "v ") == 0) {
      ++vertex;
      const char* cursor = text.c_str() + begin + 1;
      for (const char axis : {'x', 'y', 'z'}) {
        char* after = nullptr;
        const double value = std::strtod(cursor, &after);
        mc::require(after != cursor && after <= text.c_str() + end, "line {}: vertex {} has no number for {}", line + 1, vertex, axis);
        mc::require(std::isfinite(static_cast<float>(value)), "line {}: vertex {} has {} = {}, which is not finite", line + 1, vertex, axis, value);
        cursor = after;
      }
    }
    begin = end + 1;
  }
}

} // namespace

TriangleMesh read_obj(const std::string& path, const Transform& to_world) {
  const std::string text = mc::read_file(path);
  return mc::with_context(path, [&] {
    tinyobj::ObjReader reader;
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    const bool parsed = reader.ParseFromString(text, "", config);
    std::string problem = reader.Error();
    while (!problem.empty() && std::isspace(static_cast<unsigned char>(problem.back()))) problem.pop_back();
    mc::require(parsed, "broken OBJ: {}", problem.empty() ? "unreadable" : problem);

    const tinyobj::attrib_t& attributes = reader.GetAttrib();
    const auto n_positions = static_cast<int>(attributes.vertices.size() / 3), n_normals = static_cast<int>(attributes.normals.size() / 3),
               n_uvs = static_cast<int>(attributes.texcoords.size() / 2);
    check_vertices(text);

    const Eigen::Matrix3d linear = to_world.leftCols<3>(), normal_map = linear.inverse().transpose();
    const bool mirrored = linear.determinant() < 0;
    bool has_normals = n_normals > 0, has_uvs = n_uvs > 0;
    for (const auto& shape : reader.GetShapes())
      for (const auto& corner : shape.mesh.indices) has_normals &= corner.normal_index >= 0, has_uvs &= corner.texcoord_index >= 0;

    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::map<std::tuple<int, int, int>, std::uint32_t> known; // one vertex per distinct corner
    for (const auto& shape : reader.GetShapes()) {
      for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& corner = shape.mesh.indices[i + k];
          mc::require(corner.vertex_index >= 0 && corner.vertex_index < n_positions, "face {} names vertex {}, but there are only {}", i / 3 + 1,
                      corner.vertex_index + 1, n_positions);
          mc::require(!has_normals || corner.normal_index < n_normals, "face {} names normal {}, but there are only {}", i / 3 + 1, corner.normal_index + 1, n_normals);
          mc::require(!has_uvs || corner.texcoord_index < n_uvs, "face {} names texture coordinate {}, but there are only {}", i / 3 + 1, corner.texcoord_index + 1, n_uvs);
          const std::tuple key(corner.vertex_index, has_normals ? corner.normal_index : -1, has_uvs ? corner.texcoord_index : -1);
          const auto [it, added] = known.try_emplace(key, static_cast<std::uint32_t>(positions.size()));
          if (added) {
            const auto at = [](const std::vector<tinyobj::real_t>& v, int index) {
              const auto j = static_cast<std::size_t>(index) * 3;
              return Vec3d(double(v[j]), double(v[j + 1]), double(v[j + 2]));
            };
            positions.push_back((linear * at(attributes.vertices, corner.vertex_index) + to_world.col(3)).cast<Float>());
            if (has_normals) normals.push_back((normal_map * at(attributes.normals, corner.normal_index)).normalized().cast<Float>());
            if (has_uvs) {
              const auto j = static_cast<std::size_t>(corner.texcoord_index) * 2;
              uvs.emplace_back(Float(attributes.texcoords[j]), Float(attributes.texcoords[j + 1]));
            }
          }
          triangle[k] = it->second;
        }
        if (mirrored) std::swap(triangle[1], triangle[2]);
        triangles.push_back(triangle);
      }
    }
    // The library leaves out a larger polygon with a bad index and says so only in a warning.
    mc::require(reader.Warning().find("ndices out of bounds") == std::string::npos && reader.Warning().find("invalid vertex index") == std::string::npos,
                "a polygon names a vertex, normal or texture coordinate that does not exist");
    return TriangleMesh(std::move(positions), std::move(triangles), std::move(normals), std::move(uvs));
  });
}

} // namespace render
