#pragma once
/// Disks and ellipses.

#include <render/core/transform.h>
#include <render/shape/concept.h>

namespace render {

/// The plane of a disk, relative to its centre.
struct DiskPlane {
  double normal[3], ///< Normal of any length.
      x[3],         ///< The product with a point of the plane is the x of this point in the unit disk.
      y[3];         ///< As x.
};

/// Crossing of a line with the plane of a disk.
template <class T> struct DiskCrossing {
  T t;       ///< Parameter of the line; not finite for a parallel line.
  T radius2; ///< Squared distance from the centre in the unit disk; the line hits the disk if it is at most 1.
};

/// The crossing of the line o + t d with the plane of a disk; (ox, oy, oz) is o relative to the centre. The vectors are
/// those of DiskPlane. T is double for one disk, EightDoubles for eight.
template <class T>
DiskCrossing<T> disk_crossing(const T (&n)[3], const T (&x)[3], const T (&y)[3], const T& ox, const T& oy, const T& oz,
                              const Vec3d& d) {
  const T slope = n[0] * d.x() + n[1] * d.y() + n[2] * d.z();
  const T t = -(n[0] * ox + n[1] * oy + n[2] * oz) / slope;
  const T px = ox + t * d.x(), py = oy + t * d.y(), pz = oz + t * d.z();
  const T a = x[0] * px + x[1] * py + x[2] * pz, b = y[0] * px + y[1] * py + y[2] * pz;
  return {t, a * a + b * b};
}

/// The unit disk in the plane z = 0 under an affine map: a disk or an ellipse. Intersected in double.
///   normal : the image of (0, 0, 1) as a normal, or its opposite if `flipped`.
///   sample : uniform in area, by the concentric map of the unit disk.
///   pdf    : distance^2 / (|cos| area) [1/sr].
///   uv     : (r, phi / 2 pi) in the unit disk, in [0, 1] x [0, 1).
///   throws : Error unless the centre and the axes are finite and the area is > 0.
///   Source : the shape `disk` of Mitsuba; [ShirleyChiu97] for the map.
class Disk {
 public:
  /// The image of the unit disk.
  explicit Disk(const Transform& to_world, bool flipped = false);

  /// Parameter of the crossing with 0 < t < t_max.
  std::optional<double> intersect(const Ray& ray) const;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const;
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const;
  std::optional<SurfacePoint> sample_area(const Vec2& u) const;
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const;
  Float pdf(const Vec3& ref, const Vec3& wi) const;
  double area() const { return area_; }
  Eigen::AlignedBox3d box() const;
  Ball bounding_ball() const;
  bool is_spherical() const { return false; }
  double projected_solid_angle_bound(const Vec3& ref) const;
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

  bool has_uv() const { return true; }
  mc::Vec2<double> uv(const SurfacePoint& point) const;
  mc::Vec2<double> uv(const Hit&, const SurfacePoint& point) const { return uv(point); }
  double uv_scale(const Hit&, const SurfacePoint& point) const;
  void discard_uvs() {}
  void discard_sampling_table() {}

  /// Centre of the disk.
  const Vec3d& center() const { return center_; }
  /// Plane of the disk.
  const DiskPlane& plane() const { return plane_; }

 private:
  DiskCrossing<double> crossing(const Vec3d& o, const Vec3d& d) const {
    const Vec3d from = o - center_;
    return disk_crossing(plane_.normal, plane_.x, plane_.y, from.x(), from.y(), from.z(), d);
  }
  SurfacePoint point(const Vec3d& p) const; ///< The point p of the disk with its normals.
  Float area_pdf(Float cosine, Float distance2) const {
    return cosine > 0 ? distance2 / (cosine * Float(area_)) : Float(0);
  }

  Vec3d center_, x_, y_; ///< Images of the origin and of the axes.
  DiskPlane plane_;
  Vec3 normal_;
  double area_;
  Float error_; ///< Error of each coordinate of a point before it is rounded to Float.
};

} // namespace render
