#include <render/io/mesh/mesh.h>

#include <mc/core/error.h>

#include <Eigen/LU>

namespace render {

TriangleMesh to_shape(const MeshFile& file, const Transform& to_world, bool flat) {
  std::vector<Vec3> positions, normals;
  positions.reserve(file.positions.size());
  for (const Vec3d& p : file.positions) positions.push_back(to_world.point(p).cast<Float>());
  if (!flat) {
    const Eigen::Matrix3d normal_map = to_world.linear.inverse().transpose();
    normals.reserve(file.normals.size());
    for (const Vec3d& n : file.normals) normals.push_back((normal_map * n).stableNormalized().cast<Float>());
  }
  auto triangles = file.triangles;
  if (to_world.mirrors())
    for (auto& t : triangles) std::swap(t[1], t[2]);
  return TriangleMesh(std::move(positions), triangles, std::move(normals), file.uvs);
}

} // namespace render
