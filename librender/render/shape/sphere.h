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
///   throws : Error unless centre and radius are finite, radius > 0, axis is not 0 and 0 < height <= 2 radius
class Sphere {
 public:
  Sphere(const Vec3d& center, double radius, bool inside_out = false);
  static Sphere cap(const Vec3d& center, double radius, const Vec3d& axis, double height, bool inside_out = false);

  /// The nearest crossing with 0 < t < t_max.
  std::optional<double> intersect(const Ray& ray) const;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const;
  double spread(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  /// No texture lies on spheres yet.
  bool has_uv() const { return false; }
  mc::Vec2<double> uv(const Hit&) const { return {0, 0}; }
  void forget_uvs() {}

  const Vec3d& center() const { return center_; }
  double radius() const { return radius_; }
  const Vec3d& axis() const { return axis_; }
  double height() const { return height_; }
  bool is_cap() const { return height_ < 2 * radius_; }

 private:
  SurfacePoint point(const Vec3d& direction) const; ///< of the surface in the unit `direction` from the centre
  bool holds(const Vec3d& offset) const; ///< whether the sphere's point at this offset from the centre is the shape's
  bool is_cone(double d2) const;         ///< seen from squared distance d2: a whole sphere from outside
  Float cone_pdf(double d2) const;

  Vec3d center_;
  double radius_;
  Vec3d axis_ = Vec3d::UnitZ();
  double height_;
  bool inside_out_;
  double extent_;   ///< its largest coordinate is at most this
  double outside2_; ///< squared distance from the centre of points that rounding cannot have put outside
};

} // namespace render
