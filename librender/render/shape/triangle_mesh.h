#pragma once
/// Triangle meshes; rectangles and boxes are meshes too.

#include <render/shape/concept.h>

#include <array>
#include <cstdint>
#include <vector>

namespace render {

/// Affine map of points: rows of a 3x4 matrix.
using Transform = Eigen::Matrix<double, 3, 4>;

/// Triangles over shared vertices. The geometric normal follows the winding (counter-clockwise seen from its side).
///   sample : uniform in area; pdf distance^2 / (|cos| area) [1/sr]
///   throws : Error when an index is out of range, a coordinate is not finite, or there is no triangle. A degenerate triangle
///            is allowed: it is never hit and never sampled.
class TriangleMesh {
 public:
  TriangleMesh(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
               std::vector<Vec3> normals = {}, std::vector<Vec2> uvs = {});

  /// The square [-1,1]^2 in the plane z = 0, normal +z, under `to_world`.
  static TriangleMesh rectangle(const Transform& to_world);
  /// The cube [-1,1]^3, normals outward, under `to_world`.
  static TriangleMesh box(const Transform& to_world);

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const { return area_; }
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  std::size_t size() const { return triangles_.size(); }
  std::array<Vec3, 3> vertices(std::size_t triangle) const {
    const auto& t = triangles_[triangle];
    return {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  }

 private:
  SurfacePoint point(std::size_t triangle, double b1, double b2) const;

  std::vector<Vec3> positions_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Vec3> normals_; ///< per vertex; empty: flat
  std::vector<Vec2> uvs_;     ///< per vertex; empty: none
  std::vector<Vec3> face_normals_; ///< unit; 0 for a degenerate triangle
  std::vector<double> cumulative_area_, reciprocal_area_;
  double area_ = 0;
  Float error_ = 0; ///< of an interpolated point, per coordinate
};

} // namespace render
