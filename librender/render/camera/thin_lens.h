#pragma once
/// The camera.

#include <render/core/ray.h>
#include <render/core/transform.h>

#include <mc/warp/disk.h>

#include <optional>

namespace render {

/// The axis of the film that the field of view spans.
enum class FovAxis {
  x,       ///< Horizontal axis.
  y,       ///< Vertical axis.
  smaller, ///< Shorter axis.
  larger,  ///< Longer axis.
  diagonal ///< Diagonal.
};

/// Field of view, lens and clipping of a camera.
struct LensOptions {
  FovAxis fov_axis = FovAxis::x;     ///< Axis of the field of view.
  double fov = 90;                   ///< Field of view along fov_axis [degrees].
  double radius = 0;                 ///< Radius of the lens [scene units]; 0: a pinhole.
  double focus_distance = 1;         ///< Distance of the plane in focus [scene units].
  double near = 0;                   ///< Distance of the near plane [scene units]; nearer objects are invisible.
  double far = mc::infinity<double>; ///< Distance of the far plane [scene units]; farther objects are invisible.
  double half_width = 0;             ///< Half the width of the film, for parallel rays [scene units]; 0: a lens.
};

/// Connection of a scene point to a point of the lens.
struct CameraWiSample {
  Vec2 s;              ///< Film point as in ThinLens::ray.
  Vec3 wi;             ///< Unit direction from the scene point to the lens.
  Float t_max;         ///< Distance from the scene point along wi to the near plane.
  Float distance;      ///< Distance to the lens, or to its plane along parallel rays.
  Float direction_pdf; ///< See ThinLens::direction_pdf().
};

/// A thin lens that is focused on a plane; with radius 0 a pinhole; with half_width an orthographic projection,
/// which has no lens: its film points lie in the plane of the frame.
///   to_world : camera frame with x to the left, y up and z forward. The common length of the axes does not matter.
///   throws   : Error unless the frame is finite, with axes that are not 0, of equal length and orthogonal up to 1e-4.
///              Error unless 0 < fov < 180, radius, half_width and near are finite and >= 0, focus_distance is
///              finite and > 0, and far > near. Error for a radius and a half_width.
class ThinLens {
 public:
  /// A camera in a frame.
  explicit ThinLens(const Transform& to_world = {}, const LensOptions& options = {});

  /// Centre of the lens.
  const Vec3& origin() const { return origin_; }
  /// Unit vector to the right.
  const Vec3& right() const { return right_; }
  /// Unit vector upward.
  const Vec3& up() const { return up_; }
  /// Unit vector of the view direction.
  const Vec3& forward() const { return forward_; }
  /// Radius of the lens.
  Float radius() const { return radius_; }
  /// Distance of the near plane.
  Float near() const { return near_; }
  /// Whether all rays have the same direction.
  bool is_parallel() const { return is_parallel_; }

  /// Tangents of half the horizontal and half the vertical field of view; for parallel rays half the width and half the
  /// height of the film [scene units]. `aspect` is width / height of the film.
  Vec2 tan_half(Float aspect) const {
    if (is_parallel_) return {half_size_, half_size_ / aspect};
    if (fov_axis_ == FovAxis::diagonal) return Vec2(aspect, 1) * (half_size_ / std::hypot(aspect, Float(1)));
    const bool along_x = fov_axis_ == FovAxis::x || (fov_axis_ == FovAxis::smaller && aspect < 1) ||
                         (fov_axis_ == FovAxis::larger && aspect >= 1);
    return along_x ? Vec2(half_size_, half_size_ / aspect) : Vec2(half_size_ * aspect, half_size_);
  }

  /// Camera ray through the film point s in [0,1]^2, with (0,0) in the top left corner. u in [0,1)^2 selects the point
  /// of the lens.
  Ray ray(const Vec2& s, const Vec2& tan_half_xy, const Vec2& u) const {
    const Vec3 aside = right_ * ((2 * s[0] - 1) * tan_half_xy[0]) + up_ * ((1 - 2 * s[1]) * tan_half_xy[1]);
    if (is_parallel_) return {origin_ + aside + near_ * forward_, forward_, depth_};
    const Vec3 toward = aside + forward_;
    Vec3 start = origin_, d = toward;
    if (radius_ > 0) {
      const Vec2 lens = radius_ * mc::UniformDisk<Float>{}.sample(u);
      const Vec3 offset = right_ * lens[0] + up_ * lens[1];
      start += offset;
      d = toward - offset / focus_distance_;
    }
    // d.dot(forward) = 1, so `near` times d reaches the near plane, and `depth` times d leads from there to the far
    // plane.
    return {start + near_ * d, d.normalized(), depth_ * d.norm()};
  }

  /// Distance over which direction_pdf() becomes a density of areas across the ray: the distance to the lens, or 1 for
  /// parallel rays, which do not spread.
  double spread(double distance) const { return is_parallel_ ? 1 : distance; }

  /// Connection of p to the point of the lens that u selects; none if p is not between the near and far planes. s may
  /// lie outside the film.
  std::optional<CameraWiSample> sample_wi(const Vec3& p, const Vec2& tan_half_xy, const Vec2& u) const {
    Vec3 offset = Vec3::Zero();
    if (radius_ > 0) {
      const Vec2 lens = radius_ * mc::UniformDisk<Float>{}.sample(u);
      offset = right_ * lens[0] + up_ * lens[1];
    }
    const Vec3 away = p - (origin_ + offset);
    const Float z = away.dot(forward_);
    if (!(z > near_ && z - near_ < depth_)) return {};
    if (is_parallel_) {
      const Vec2 s((away.dot(right_) / tan_half_xy[0] + 1) / 2, (1 - away.dot(up_) / tan_half_xy[1]) / 2);
      return CameraWiSample{s, -forward_, z - near_, z, direction_pdf(forward_, tan_half_xy)};
    }
    const Vec3 toward = away / z + offset / focus_distance_;
    const Float distance = away.norm(), cosine = z / distance, area = 4 * tan_half_xy[0] * tan_half_xy[1];
    return CameraWiSample{{(toward.dot(right_) / tan_half_xy[0] + 1) / 2, (1 - toward.dot(up_) / tan_half_xy[1]) / 2},
                          -away / distance,
                          (z - near_) / cosine,
                          distance,
                          1 / (cosine * cosine * cosine * area)};
  }

  /// Density of a camera ray's direction [1/sr], for s uniform in [0,1]^2. For parallel rays the density of its place
  /// [1 / area], since the direction is given.
  Float direction_pdf(const Vec3& d, const Vec2& tan_half_xy) const {
    if (is_parallel_) return 1 / (4 * tan_half_xy[0] * tan_half_xy[1]);
    const Float cosine = d.dot(forward_);
    return 1 / (cosine * cosine * cosine * 4 * tan_half_xy[0] * tan_half_xy[1]);
  }

 private:
  Vec3 origin_, right_, up_, forward_; ///< Centre of the lens, and orthonormal axes.
  FovAxis fov_axis_;
  bool is_parallel_;
  Float half_size_; ///< Tangent of half the field of view, or half the width of parallel rays.
  Float radius_, focus_distance_, near_, depth_;
};

} // namespace render
