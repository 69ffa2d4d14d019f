#pragma once
/// Spheres and spherical caps.

#include <render/shape/concept.h>

#include <mc/warp/cone.h>

namespace render {

/// A sphere, or the cap of a sphere within `height` of the pole `axis`. Intersected and sampled in double: the walls of
/// smallpt (radius 1e5) and ground spheres of radius 1000 are exact to a float ulp.
///   normal : outward; inward if `inside_out`.
///   sample : uniform in the subtended cone for a whole sphere and ref outside; otherwise uniform in area.
///   pdf    : 1 / (2 pi (1 - cos theta_max)), or distance^2 / (|cos| area) [1/sr].
///   uv     : v is the angle from the pole of the texture axes [pi], u the angle about it [2 pi].
///   throws : Error unless the centre is finite, 0 < radius <= max_radius, axis is not 0 and 0 < height <= 2 radius.
class Sphere {
 public:
  /// Largest radius; distances are Floats.
  static constexpr double max_radius = double(std::numeric_limits<Float>::max()) / 4;

  /// A whole sphere.
  Sphere(const Vec3d& center, double radius, bool inside_out = false);
  /// The cap of height `height` about the pole in direction `axis`.
  static Sphere cap(const Vec3d& center, double radius, const Vec3d& axis, double height, bool inside_out = false);

  /// The same sphere with rotated texture coordinates. The columns are the points with u = 0 and u = 1/4 on the
  /// equator, and the pole v = 0. u ranges from min_u to min_u + 1. The default is x, y, z and 0.
  ///   throws : Error unless the axes are orthonormal within 1e-6.
  Sphere with_uv_axes(const Eigen::Matrix3d& axes, double min_u = 0) const;

  /// Parameter of the nearest crossing with 0 < t < t_max.
  std::optional<double> intersect(const Ray& ray) const;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const;
  /// Bounding box of the whole sphere, even for a cap.
  Eigen::AlignedBox3d box() const { return {center_.array() - radius_, center_.array() + radius_}; }
  /// The whole sphere, even for a cap.
  Ball bounding_ball() const { return {center_, radius_}; }
  bool is_spherical() const { return true; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  bool has_uv() const { return true; }
  mc::Vec2<double> uv(const SurfacePoint& point) const;
  mc::Vec2<double> uv(const Hit&, const SurfacePoint& point) const { return uv(point); }
  double uv_scale(const Hit&, const SurfacePoint& point) const;
  void discard_uvs() {}
  void discard_sampling_table() {}

  /// Centre of the sphere.
  const Vec3d& center() const { return center_; }
  /// Radius of the sphere.
  double radius() const { return radius_; }
  /// Unit direction from the centre to the pole of the cap.
  const Vec3d& axis() const { return axis_; }
  /// Height of the cap; 2 radius() for a whole sphere.
  double height() const { return height_; }
  /// Whether the shape is a cap rather than a whole sphere.
  bool is_cap() const { return height_ < 2 * radius_; }

 private:
  SurfacePoint point(const Vec3d& direction) const; ///< surface point in the unit `direction` from the centre
  /// Whether the point of the sphere at this offset from the centre belongs to the shape.
  bool contains(const Vec3d& offset) const;
  /// Whether `sample` uses the cone at squared distance d2: for a whole sphere from outside.
  bool samples_cone(double d2) const;
  Float cone_pdf(double d2) const;

  Vec3d center_;
  double radius_;
  Vec3d axis_ = Vec3d::UnitZ();
  Eigen::Matrix3d uv_axes_ = Eigen::Matrix3d::Identity();
  double min_u_ = 0;
  double height_;
  bool inside_out_;
  double extent_;   ///< bound of the coordinates of the sphere
  double outside2_; ///< least squared distance from the centre of a point that counts as outside, despite rounding
};

} // namespace render
