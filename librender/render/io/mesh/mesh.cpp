#include <render/io/mesh/mesh.h>

#include <mc/core/error.h>
#include <mc/core/memory.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace render {

namespace {

// Sums the normals of the triangles at each vertex, weighted by their angles there. The result does not depend on how a
// polygon was split.
std::vector<Vec3> smooth_normals(const std::vector<Vec3d>& positions,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Vec3d> sums(positions.size(), Vec3d::Zero());
  for (const auto& t : triangles) {
    const Vec3d normal =
        mc::cross<double>(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]).stableNormalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d &at = positions[t[i]], a = positions[t[(i + 1) % 3]] - at, b = positions[t[(i + 2) % 3]] - at;
      sums[t[i]] += std::atan2(mc::cross<double>(a, b).stableNorm(), a.dot(b)) * normal;
    }
  }
  std::vector<Vec3> normals;
  normals.reserve(sums.size());
  for (const Vec3d& n : sums) normals.push_back(n.stableNormalized().cast<Float>());
  return normals;
}

// Orients triangles so that their normals lie on the side of the normals of their vertices.
void wind_about(const std::vector<Vec3>& normals, const std::vector<Vec3d>& positions,
                std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (normals.size() != positions.size()) return; // TriangleMesh will reject it
  for (auto& t : triangles) {
    const Vec3d normal = mc::cross<double>(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
    const Vec3 meant = normals[t[0]] + normals[t[1]] + normals[t[2]];
    if (normal.dot(meant.cast<double>()) < 0) std::swap(t[1], t[2]);
  }
}

} // namespace

void require_valid_mesh(const MeshFile& file) {
  const auto require_finite = [](const char* what, const std::vector<Vec3d>& all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      mc::require(all[i].allFinite(), "{} {} = ({}, {}, {}) is not finite", what, i, all[i][0], all[i][1], all[i][2]);
  };
  require_finite("vertex", file.positions);
  require_finite("normal", file.normals);
  for (std::size_t i = 0; i < file.triangles.size(); ++i)
    for (const std::uint32_t v : file.triangles[i])
      mc::require(v < file.positions.size(), "triangle {} names vertex {}, but there are only {}", i, v,
                  file.positions.size());
}

MeshFile split_at_edges(const MeshFile& file, const Transform& to_world, double degrees) {
  mc::require(degrees >= 0 && degrees <= 180, "maxSmoothAngle {} must lie in [0, 180] degrees", degrees);
  const double least = std::cos(degrees * mc::pi<double> / 180);
  struct SmoothingGroup {
    Vec3d normal;
    std::uint32_t vertex;
  };
  std::map<std::array<double, 5>, std::vector<SmoothingGroup>> sides; // groups at each position and texture coordinate
  MeshFile split;
  split.missing_uv_reason = file.missing_uv_reason;
  split.meshes = file.meshes;
  for (auto triangle : file.triangles) {
    const auto corner = [&](std::size_t i) { return to_world.point(file.positions[triangle[i]]); };
    const Vec3d normal = mc::cross<double>(corner(1) - corner(0), corner(2) - corner(0)).stableNormalized();
    for (std::uint32_t& v : triangle) {
      const Vec3d& p = file.positions[v];
      const mc::Vec2<float> uv = file.uvs.empty() ? mc::Vec2<float>(0, 0) : file.uvs[v];
      auto& about = sides[{p[0], p[1], p[2], double(uv[0]), double(uv[1])}];
      auto side = std::find_if(about.begin(), about.end(), [&](const SmoothingGroup& s) {
        return s.normal == normal || s.normal.dot(normal) > least;
      });
      if (side == about.end()) {
        side = about.insert(side, {normal, static_cast<std::uint32_t>(split.positions.size())});
        split.positions.push_back(p);
        if (!file.uvs.empty()) split.uvs.push_back(uv);
      }
      v = side->vertex;
    }
    split.triangles.push_back(triangle);
  }
  return split;
}

TriangleMesh to_shape(const MeshFile& file, const Transform& to_world, bool flat) {
  constexpr double vertex = 2 * sizeof(Vec3d) + 2 * sizeof(Vec3), // placed and summed, and as the mesh keeps them
      triangle = 6 * sizeof(std::uint32_t) + sizeof(Vec3) + 2 * sizeof(double); // sorted, kept, and a row of its table
  mc::require_memory(vertex * double(file.positions.size()) + triangle * double(file.triangles.size()),
                     fmt::format("{} triangles", file.triangles.size()));
  std::vector<Vec3d> placed;
  std::vector<Vec3> positions, normals;
  placed.reserve(file.positions.size());
  positions.reserve(file.positions.size());
  for (const Vec3d& p : file.positions) {
    placed.push_back(to_world.point(p));
    positions.push_back(placed.back().cast<Float>());
  }
  if (!flat && !file.normals.empty()) {
    const Eigen::Matrix3d normal_map = to_world.linear.inverse().transpose();
    normals.reserve(file.normals.size());
    for (const Vec3d& n : file.normals) normals.push_back((normal_map * n).stableNormalized().cast<Float>());
  }
  auto triangles = file.triangles;
  if (to_world.mirrors())
    for (auto& t : triangles) std::swap(t[1], t[2]);
  const bool are_in_range = std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t i) { return i < placed.size(); });
  });
  if (!flat && are_in_range) {
    if (file.normals.empty()) normals = smooth_normals(placed, triangles);
    else wind_about(normals, placed, triangles);
  }
  TriangleMesh mesh(std::move(positions), triangles, std::move(normals), file.uvs);
  mc::require(mesh.area() > 0, "none of its {} triangles has an area{}: nothing would be seen", mesh.size(),
              sizeof(Float) == sizeof(float) ? " in single precision" : "");
  return mesh;
}

std::vector<MeshFile> parts_of(const MeshFile& file) {
  std::vector<std::vector<std::size_t>> triangles(file.material_names.size());
  for (std::size_t t = 0; t < file.triangle_materials.size(); ++t) triangles[file.triangle_materials[t]].push_back(t);
  std::vector<MeshFile> parts(triangles.size());
  constexpr std::uint32_t unused = 0xffffffff;
  std::vector<std::uint32_t> places(file.positions.size(), unused), used;
  for (std::size_t m = 0; m < parts.size(); ++m) {
    MeshFile& part = parts[m];
    part.missing_uv_reason = file.missing_uv_reason;
    const auto place_of = [&](std::uint32_t i) {
      if (places[i] != unused) return places[i];
      places[i] = static_cast<std::uint32_t>(part.positions.size());
      used.push_back(i);
      part.positions.push_back(file.positions[i]);
      if (!file.normals.empty()) part.normals.push_back(file.normals[i]);
      if (!file.uvs.empty()) part.uvs.push_back(file.uvs[i]);
      return places[i];
    };
    for (const std::size_t t : triangles[m]) {
      const auto& [i, j, k] = file.triangles[t];
      part.triangles.push_back({place_of(i), place_of(j), place_of(k)});
    }
    for (const std::uint32_t i : used) places[i] = unused;
    used.clear();
  }
  return parts;
}

} // namespace render
