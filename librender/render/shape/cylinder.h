#pragma once
/// Cylinders.

#include <render/core/transform.h>
#include <render/shape/concept.h>

#include <mc/core/frame.h>

namespace render {

/// The wall of a circular cylinder, without its ends. Intersected in double.
///   normal : away from the axis; toward it if `flipped`.
///   sample : uniform in area.
///   pdf    : distance^2 / (|cos| area) [1/sr].
///   uv     : (angle / 2 pi, height / whole height), in [0, 1) x [0, 1].
///   throws : Error unless the ends and the radius are finite, the ends differ and the radius is > 0.
///   Source : the shape `cylinder` of Mitsuba.
class Cylinder {
 public:
  /// The cylinder of a radius around the line from `from` to `to`.
  Cylinder(const Vec3d& from, const Vec3d& to, double radius, bool flipped = false);

  /// Parameter of the nearest crossing with 0 < t < t_max.
  std::optional<double> intersect(const Ray& ray) const;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const { return 2 * mc::pi<double> * radius_ * height_; }
  Eigen::AlignedBox3d box() const;
  Ball bounding_ball() const { return {base_ + height_ / 2 * frame_.z, std::hypot(radius_, height_ / 2)}; }
  bool is_spherical() const { return false; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  bool has_uv() const { return true; }
  mc::Vec2<double> uv(const SurfacePoint& point) const;
  mc::Vec2<double> uv(const Hit&, const SurfacePoint& point) const { return uv(point); }
  double uv_scale(const Hit&, const SurfacePoint&) const;
  void discard_uvs() {}
  void discard_sampling_table() {}

  /// Centre of the end at height 0.
  const Vec3d& base() const { return base_; }
  /// Axes: z along the cylinder.
  const mc::Frame<double>& frame() const { return frame_; }
  /// Radius.
  double radius() const { return radius_; }
  /// Distance of the ends.
  double height() const { return height_; }

 private:
  SurfacePoint point(double cosine, double sine, double height) const; ///< At an angle about the axis.

  Vec3d base_;
  double height_, radius_;
  mc::Frame<double> frame_;
  bool flipped_;
  Float error_; ///< Error of each coordinate of a point before it is rounded to Float.
};

} // namespace render
