#pragma once
/// Affine maps.

#include <render/core/types.h>

namespace render {

/// The affine map p -> linear p + translation, in double; the identity by default.
struct Transform {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(); ///< Linear part.
  Vec3d translation = Vec3d::Zero();                    ///< Image of the origin.

  /// The map with the given images of the axes and of the origin.
  static Transform columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& origin);
  /// Translation by v.
  static Transform translate(const Vec3d& v);
  /// Scaling along the axes by s.
  static Transform scale(const Vec3d& s);
  /// Rotation about `axis` through the origin by Rodrigues' formula.
  ///   throws : Error for an axis of length 0.
  static Transform rotate(const Vec3d& axis, double degrees);
  /// The frame of a camera: x to its left, y up and z forward, as in Mitsuba.
  ///   throws : Error if target - origin is 0 or parallel to up.
  static Transform look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

  /// Image of a point.
  Vec3d point(const Vec3d& p) const;
  /// Image of a vector.
  Vec3d vector(const Vec3d& v) const;
  /// Image of a normal, not unit. Outward normals stay outward, also under mirroring.
  Vec3d normal(const Vec3d& n) const;
  /// Whether the map reverses handedness.
  bool mirrors() const;

  /// The composition: applies `first`, then this map.
  Transform operator*(const Transform& first) const;
};

} // namespace render
