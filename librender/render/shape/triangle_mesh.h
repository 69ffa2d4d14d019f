#pragma once
/// Triangle meshes, including rectangles and boxes.

#include <render/core/bounds.h>
#include <render/core/transform.h>
#include <render/shape/concept.h>

#include <mc/table/table_dist_1d.h>
#include <mc/warp/spherical_triangle.h>

#include <array>
#include <cstdint>
#include <vector>

namespace render {

/// Triangles over shared vertices. The geometric normal follows the winding: it points to the side from which the
/// vertices are counter-clockwise.
///   sample : selects a triangle by its area. On a distant triangle the point is uniform in area. For a triangle close
///            to ref the direction is uniform in solid angle; uniform area would have a nearly infinite variance there.
///   pdf    : distance^2 / (|cos| area), or triangle area / (area * solid angle) [1/sr].
///   throws : Error if an index is out of range, a coordinate is not finite, or there is no triangle. Degenerate
///            triangles are allowed; they are never hit and never sampled.
class TriangleMesh {
 public:
  /// A mesh from vertices and triangles of vertex indices.
  ///   normals : shading normals, one per vertex, or none. If all agree with their triangles, they are dropped.
  ///   uvs     : texture coordinates, one per vertex, or none.
  TriangleMesh(std::vector<Vec3> positions, const std::vector<std::array<std::uint32_t, 3>>& triangles,
               std::vector<Vec3> normals = {}, std::vector<mc::Vec2<float>> uvs = {});

  /// The square [-1,1]^2 in the plane z = 0, transformed by `to_world`. Its normal is the transformed (0, 0, 1), also
  /// under mirroring.
  static TriangleMesh rectangle(const Transform& to_world);
  /// The cube [-1,1]^3 with outward normals, transformed by `to_world`. Texture coordinates cover [0,1]^2 on each side.
  static TriangleMesh box(const Transform& to_world);

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const { return area_; }
  /// The smallest ball around the centre of the bounding box.
  Ball bounding_ball() const;
  bool is_spherical() const { return false; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;
  /// Point with the barycentric weights b1 and b2 of vertices 1 and 2.
  SurfacePoint point(std::size_t triangle, double b1, double b2) const;

  bool has_uv() const { return !uvs_.empty(); }
  mc::Vec2<double> uv(const Hit& hit, const SurfacePoint&) const;
  mc::Vec2<double> uv(const SurfacePoint& point) const;
  double uv_scale(const Hit& hit, const SurfacePoint&) const;
  /// Frees the memory of texture coordinates that nothing reads.
  void discard_uvs() { uvs_ = decltype(uvs_)(); }
  /// Frees the distribution over triangles of a mesh that is never sampled. sample() then returns nullopt.
  void discard_sampling_table() { triangle_distribution_.reset(); }

  /// Number of triangles.
  std::size_t size() const { return faces_.size(); }
  /// Bounds of all triangles.
  const Bounds& bounds() const { return bounds_; }
  /// Bounding box in double.
  Eigen::AlignedBox3d box() const { return {bounds_.lo.cast<double>(), bounds_.hi.cast<double>()}; }
  /// Corners of a triangle.
  std::array<Vec3, 3> vertices(std::size_t triangle) const {
    const auto& [i, j, k] = faces_[triangle].vertices;
    return {positions_[i], positions_[j], positions_[k]};
  }

 private:
  SurfacePoint at(const Vec3d& p, std::size_t triangle, Float b1, Float b2) const;
  /// The directions from ref through a triangle that ref nearly touches: ref lies less than a quarter of the triangle's
  /// radius from its plane, and next to the triangle. nullopt otherwise, and for a triangle viewed edge-on.
  std::optional<mc::SphericalTriangle<double>> near_triangle(const Vec3& ref, std::size_t triangle) const;
  ShapeSample sample_near(const Vec3& ref, std::size_t triangle, const mc::SphericalTriangle<double>& directions,
                          const mc::Vec2<double>& u) const;
  // Densities [1/sr] of a direction to a near triangle, and to a far triangle at cosine `cosine`.
  Float near_pdf(std::size_t triangle, const mc::SphericalTriangle<double>& directions) const;
  Float area_pdf(Float cosine, Float distance2) const;

  struct Face {
    std::array<std::uint32_t, 3> vertices;
    Vec3 normal; ///< unit; 0 for a degenerate triangle
  };
  std::vector<Vec3> positions_, normals_; ///< per vertex; a flat mesh has no normals
  std::vector<mc::Vec2<float>> uvs_;
  std::vector<Face> faces_;
  std::optional<mc::TableDist1D<double>>
      triangle_distribution_; ///< of triangles by area; none if all areas are 0, or after discard_sampling_table()
  double area_ = 0;
  Bounds bounds_;
  Float largest_radius2_ = 0; ///< largest squared radius of a triangle about its centre
  Float error_ = 0;           ///< error per coordinate of an interpolated point before it is rounded to Float
};

} // namespace render
