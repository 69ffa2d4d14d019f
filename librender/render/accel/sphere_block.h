#pragma once
/// Spheres as leaves of the BVH.

#include <render/accel/whole_shape_block.h>
#include <render/shape/sphere.h>
#include <render/shape/sphere_crossings.h>

namespace render {

/// Eight spheres or caps, intersected in double. A block type of BlockTree.
class SphereBlock : public WholeShapeBlock<Sphere> {
 public:
  /// The ray in double.
  struct RaySetup : Line {
    explicit RaySetup(const Ray& ray) : Line(ray.o.cast<double>(), ray.d.cast<double>()) {}
  };

  /// Stores a sphere in a lane.
  void set(std::uint32_t lane, const Primitive& p) {
    const Sphere& s = *p.geometry;
    for (int a = 0; a < 3; ++a) {
      center_[a][lane] = s.center()[a];
      axis_[a][lane] = s.axis()[a];
    }
    radius2_[lane] = s.radius() * s.radius();
    cap_[lane] = s.is_cap() ? s.radius() - s.height() : -mc::infinity<double>;
    caps_ |= s.is_cap();
    set_shape(lane, p.shape);
  }

  /// Nearest hit with 0 < t < t_max, stored in t_max and hit; with any = true, only whether there is a hit.
  template <bool any> bool intersect(const Ray&, const RaySetup& line, Float& t_max, Hit& hit) const {
    const EightDoubles ox = line.o.x() - center_[0], oy = line.o.y() - center_[1], oz = line.o.z() - center_[2];
    const auto pass = sphere_quadratic(ox, oy, oz, line, radius2_);
    const auto crossed = pass.crosses_ahead();
    if (detail::lane_bits(crossed) == 0) return false;
    const auto at = sphere_crossings(pass, line);
    const double limit = double(t_max);
    auto hit0 = crossed & (at.t0 > 0) & (at.t0 < limit), hit1 = crossed & (at.t1 > 0) & (at.t1 < limit);
    if (caps_) {
      const Vec3d& d = line.d;
      const EightDoubles along = axis_[0] * d.x() + axis_[1] * d.y() + axis_[2] * d.z();
      const EightDoubles start = axis_[0] * ox + axis_[1] * oy + axis_[2] * oz;
      hit0 &= start + at.t0 * along >= cap_;
      hit1 &= start + at.t1 * along >= cap_;
    }
    return nearest<any>(detail::lane_bits(hit0 | hit1), hit0 ? at.t0 : at.t1, t_max, hit);
  }

 private:
  EightDoubles center_[3], radius2_;
  EightDoubles axis_[3], cap_; ///< a point at `offset` from the centre belongs to the shape if offset . axis >= cap
  bool caps_ = false;          ///< whether some lane is a cap
};

} // namespace render
