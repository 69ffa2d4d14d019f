#pragma once
/// Spheres and spherical caps.

#include <render/shape/concept.h>

#include <mc/warp/cone.h>

namespace render {

/// A sphere, or the cap of it that lies within `height` of the pole `axis`. Intersected and sampled in double, so that
/// the walls of smallpt (radius 1e5) and the ground of the book's scenes (radius 1000) are exact to a float ulp.
///   normal : outward; inward when `inside_out`
///   sample : a whole sphere seen from outside: uniform in the cone that it fills; otherwise uniform in area
///   pdf    : 1 / (2 pi (1 - cos theta_max)), or distance^2 / (|cos| area) [1/sr]
///   uv     : v the angle from the pole of its axes [pi], u the one about it [2 pi]
///   throws : Error unless centre is finite, 0 < radius <= most_radius, axis is not 0 and 0 < height <= 2 radius
class Sphere {
 public:
  static constexpr double max_radius = double(std::numeric_limits<Float>::max()) / 4; ///< distances are Floats

  Sphere(const Vec3d& center, double radius, bool inside_out = false);
  static Sphere cap(const Vec3d& center, double radius, const Vec3d& axis, double height, bool inside_out = false);

  /// The same sphere with its texture turned: the columns are where u = 0 and u = 1/4 cross the equator, and the pole
  /// v = 0; u goes from `min_u` to least_u + 1. At first they are x, y and z, and 0.
  ///   throws : Error unless they are orthonormal, to 1e-6
  Sphere with_uv_axes(const Eigen::Matrix3d& axes, double min_u = 0) const;

  /// The nearest crossing with 0 < t < t_max.
  std::optional<double> intersect(const Ray& ray) const;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const;
  /// Of the whole sphere, of a cap too.
  Eigen::AlignedBox3d box() const { return {center_.array() - radius_, center_.array() + radius_}; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  bool has_uv() const { return true; }
  mc::Vec2<double> uv(const Hit&, const SurfacePoint& point) const;
  void discard_uvs() {}
  void discard_sampling_table() {}

  const Vec3d& center() const { return center_; }
  double radius() const { return radius_; }
  const Vec3d& axis() const { return axis_; }
  double height() const { return height_; }
  bool is_cap() const { return height_ < 2 * radius_; }

 private:
  SurfacePoint point(const Vec3d& direction) const; ///< of the surface in the unit `direction` from the centre
  bool
  contains(const Vec3d& offset) const; ///< whether the sphere's point at this offset from the centre is the shape's
  bool samples_cone(double d2) const;  ///< seen from squared distance d2: a whole sphere from outside
  Float cone_pdf(double d2) const;

  Vec3d center_;
  double radius_;
  Vec3d axis_ = Vec3d::UnitZ();
  Eigen::Matrix3d uv_axes_ = Eigen::Matrix3d::Identity();
  double min_u_ = 0;
  double height_;
  bool inside_out_;
  double extent_;   ///< its largest coordinate is at most this
  double outside2_; ///< squared distance from the centre of points that rounding cannot have put outside
};

} // namespace render
