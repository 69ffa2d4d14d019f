#pragma once
/// Triangle meshes; rectangles and boxes are meshes too.

#include <render/core/bounds.h>
#include <render/core/transform.h>
#include <render/shape/concept.h>

#include <mc/table/table_dist_1d.h>
#include <mc/warp/spherical_triangle.h>

#include <array>
#include <cstdint>
#include <vector>

namespace render {

/// Triangles over shared vertices. The geometric normal follows the winding (counter-clockwise seen from its side).
///   sample : a triangle by its area; of a far one a point uniform in area, of one that nearly touches ref a direction
///            uniform in its solid angle, since uniform area would have an all but infinite variance there
///   pdf    : distance^2 / (|cos| area), or triangle area / (area * solid angle) [1/sr]
///   throws : Error when an index is out of range, a coordinate is not finite, or there is no triangle. A degenerate
///            triangle
///            is allowed: it is never hit and never sampled.
class TriangleMesh {
 public:
  /// uvs     : texture coordinates, one per vertex, or none
  /// normals : one per vertex, or none; where all agree with their triangles, the mesh is flat and needs none
  TriangleMesh(std::vector<Vec3> positions, const std::vector<std::array<std::uint32_t, 3>>& triangles,
               std::vector<Vec3> normals = {}, std::vector<mc::Vec2<float>> uvs = {});

  /// The square [-1,1]^2 in the plane z = 0 under `to_world`; its normal is the transformed (0, 0, 1), mirrored or not.
  static TriangleMesh rectangle(const Transform& to_world);
  /// The cube [-1,1]^3, normals outward, under `to_world`; texture coordinates fill [0,1]^2 on each side.
  static TriangleMesh box(const Transform& to_world);

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const { return area_; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;
  /// The point of barycentric weights b1 and b2 of vertices 1 and 2.
  SurfacePoint point(std::size_t triangle, double b1, double b2) const;

  bool has_uv() const { return !uvs_.empty(); }
  mc::Vec2<double> uv(const Hit& hit, const SurfacePoint&) const;
  /// Gives back the memory of texture coordinates that nothing reads.
  void discard_uvs() { uvs_ = decltype(uvs_)(); }
  /// Gives back the memory of what picks a triangle, where nothing aims at the mesh: sample() finds no point then.
  void discard_sampling_table() { triangle_distribution_.reset(); }

  std::size_t size() const { return faces_.size(); }
  /// Of all triangles; empty without any.
  const Bounds& bounds() const { return bounds_; }
  Eigen::AlignedBox3d box() const { return {bounds_.lo.cast<double>(), bounds_.hi.cast<double>()}; }
  std::array<Vec3, 3> vertices(std::size_t triangle) const {
    const auto& [i, j, k] = faces_[triangle].vertices;
    return {positions_[i], positions_[j], positions_[k]};
  }

 private:
  SurfacePoint at(const Vec3d& p, std::size_t triangle, Float b1, Float b2) const;
  /// The directions from ref through a triangle that ref nearly touches: it lies less than a quarter of the triangle's
  /// radius from the plane, and beside the triangle. Else nullopt, as for a triangle that is seen edge-on.
  std::optional<mc::SphericalTriangle<double>> near_triangle(const Vec3& ref, std::size_t triangle) const;
  ShapeSample sample_near(const Vec3& ref, std::size_t triangle, const mc::SphericalTriangle<double>& directions,
                          const mc::Vec2<double>& u) const;
  // Densities [1/sr] of a direction that meets a near triangle, and a far one at cosine `cosine`.
  Float near_pdf(std::size_t triangle, const mc::SphericalTriangle<double>& directions) const;
  Float area_pdf(Float cosine, Float distance2) const;

  struct Face {
    std::array<std::uint32_t, 3> vertices;
    Vec3 normal; ///< unit; 0 for a degenerate triangle
  };
  std::vector<Vec3> positions_, normals_; ///< per vertex; no normals: flat
  std::vector<mc::Vec2<float>> uvs_;
  std::vector<Face> faces_;
  std::optional<mc::TableDist1D<double>>
      triangle_distribution_; ///< of a triangle by its area; none where all are 0, or forgotten
  double area_ = 0;
  Bounds bounds_;
  Float largest_radius2_ = 0; ///< of the ball about a triangle's centre
  Float error_ = 0;           ///< of an interpolated point before it is rounded to Float, per coordinate
};

} // namespace render
