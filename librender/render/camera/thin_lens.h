#pragma once
/// The camera.

#include <render/core/ray.h>
#include <render/core/transform.h>

#include <mc/warp/disk.h>

#include <optional>

namespace render {

/// Which side of the film the field of view spans.
enum class FovAxis { x, y, smaller, larger, diagonal };

struct LensOptions {
  FovAxis fov_axis = FovAxis::x;
  double fov = 90;                   ///< along fov_axis [degrees]
  double radius = 0;                 ///< of the lens [scene units]; 0: a pinhole
  double focus_distance = 1;         ///< to the plane in focus [scene units]
  double near = 0;                   ///< what stands closer before the lens is cut away [scene units]
  double far = mc::infinity<double>; ///< and what stands farther
};

/// How a point is seen from a point of the lens.
struct CameraWiSample {
  Vec2 s;              ///< of the film, see ThinLens::ray
  Vec3 wi;             ///< unit direction from the point to the lens
  Float t_max;         ///< from the point along d to the near plane
  Float distance;      ///< to the lens
  Float direction_pdf; ///< [1/sr] of the direction from the lens, where s is uniform in [0,1]^2
};

/// A thin lens focused on a plane; of radius 0 a pinhole.
///   to_world : its frame: x to the left, y up, z forward; how long they are changes nothing
///   throws   : Error unless the frame is finite, its axes not 0, equally long and orthogonal (to 1e-4), 0 < fov < 180,
///              radius and near are finite and >= 0, focus_distance is finite and > 0, far > near
class ThinLens {
 public:
  explicit ThinLens(const Transform& to_world = {}, const LensOptions& options = {});

  const Vec3& origin() const { return origin_; }
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }
  Float radius() const { return radius_; }
  Float near() const { return near_; }

  /// Tangents of half the horizontal and vertical field of view for a film of width / height = aspect.
  Vec2 tan_half(Float aspect) const {
    if (fov_axis_ == FovAxis::diagonal) return Vec2(aspect, 1) * (tan_half_fov_ / std::hypot(aspect, Float(1)));
    const bool along_x = fov_axis_ == FovAxis::x || (fov_axis_ == FovAxis::smaller && aspect < 1) ||
                         (fov_axis_ == FovAxis::larger && aspect >= 1);
    return along_x ? Vec2(tan_half_fov_, tan_half_fov_ / aspect) : Vec2(tan_half_fov_ * aspect, tan_half_fov_);
  }

  /// The ray through the film point s in [0,1]^2, (0,0) its top left corner; u in [0,1)^2 chooses the point of the
  /// lens.
  Ray ray(const Vec2& s, const Vec2& tan_half_xy, const Vec2& u) const {
    const Vec3 toward = right_ * ((2 * s[0] - 1) * tan_half_xy[0]) + up_ * ((1 - 2 * s[1]) * tan_half_xy[1]) + forward_;
    Vec3 start = origin_, d = toward;
    if (radius_ > 0) {
      const Vec2 lens = radius_ * mc::UniformDisk<Float>{}.sample(u);
      const Vec3 offset = right_ * lens[0] + up_ * lens[1];
      start += offset;
      d = toward - offset / focus_distance_;
    }
    // d.dot(forward) = 1, so `near` steps of d reach the near plane, and `depth` more the far one.
    return {start + near_ * d, d.normalized(), depth_ * d.norm()};
  }

  /// How p is seen from the point of the lens that u chooses; none where it lies outside of near and far. s may lie
  /// beside the film.
  std::optional<CameraWiSample> sample_wi(const Vec3& p, const Vec2& tan_half_xy, const Vec2& u) const {
    Vec3 offset = Vec3::Zero();
    if (radius_ > 0) {
      const Vec2 lens = radius_ * mc::UniformDisk<Float>{}.sample(u);
      offset = right_ * lens[0] + up_ * lens[1];
    }
    const Vec3 away = p - (origin_ + offset);
    const Float z = away.dot(forward_);
    if (!(z > near_ && z - near_ < depth_)) return {};
    const Vec3 toward = away / z + offset / focus_distance_;
    const Float distance = away.norm(), cosine = z / distance, area = 4 * tan_half_xy[0] * tan_half_xy[1];
    return CameraWiSample{{(toward.dot(right_) / tan_half_xy[0] + 1) / 2, (1 - toward.dot(up_) / tan_half_xy[1]) / 2},
                          -away / distance,
                          (z - near_) / cosine,
                          distance,
                          1 / (cosine * cosine * cosine * area)};
  }

  /// The density of SeenPoint, of a ray's direction.
  Float direction_pdf(const Vec3& d, const Vec2& tan_half_xy) const {
    const Float cosine = d.dot(forward_);
    return 1 / (cosine * cosine * cosine * 4 * tan_half_xy[0] * tan_half_xy[1]);
  }

 private:
  Vec3 origin_, right_, up_, forward_; ///< the axes orthonormal
  FovAxis fov_axis_;
  Float tan_half_fov_, radius_, focus_distance_, near_, depth_;
};

} // namespace render
