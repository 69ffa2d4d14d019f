#pragma once
/// Affine maps.

#include <render/core/types.h>

namespace render {

/// Points p -> linear p + translation, in double; the identity by default.
struct Transform {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3d translation = Vec3d::Zero();

  /// The images of the axes and of the origin.
  static Transform columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& origin);
  static Transform translate(const Vec3d& v);
  static Transform scale(const Vec3d& s);
  /// About `axis` through the origin, by Rodrigues' formula.
  ///   throws : Error for an axis of length 0
  static Transform rotate(const Vec3d& axis, double degrees);
  /// The frame of a camera, x to its left, y up and z forward, as in Mitsuba.
  ///   throws : Error where target - origin is 0 or parallel to up
  static Transform look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

  Vec3d point(const Vec3d& p) const;
  Vec3d vector(const Vec3d& v) const;
  /// Outward normals stay outward, under mirroring too; not unit.
  Vec3d normal(const Vec3d& n) const;
  /// Whether it turns a right hand into a left one.
  bool mirrors() const;

  /// First `first`, then this.
  Transform operator*(const Transform& first) const;
};

} // namespace render
