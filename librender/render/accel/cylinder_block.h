#pragma once
/// Cylinders as leaves of the BVH.

#include <render/accel/whole_shape_block.h>
#include <render/shape/cylinder.h>
#include <render/shape/cylinder_crossings.h>

namespace render {

/// Eight cylinders, intersected in double. A block type of BlockTree.
class CylinderBlock : public WholeShapeBlock<Cylinder> {
 public:
  /// Stores a cylinder in a lane.
  void set(std::uint32_t lane, const Primitive& p) {
    const Cylinder& c = *p.geometry;
    for (int a = 0; a < 3; ++a) {
      base_[a][lane] = c.base()[a];
      x_[a][lane] = c.frame().x[a];
      y_[a][lane] = c.frame().y[a];
      z_[a][lane] = c.frame().z[a];
    }
    radius2_[lane] = mc::sqr(c.radius());
    height_[lane] = c.height();
    set_shape(lane, p.shape);
  }

  /// Nearest hit with 0 < t < t_max, stored in t_max and hit; with any = true, only whether there is a hit.
  template <bool any> bool intersect(const Ray&, const RaySetup& ray, Float& t_max, Hit& hit) const {
    const EightDoubles ox = ray.o.x() - base_[0], oy = ray.o.y() - base_[1], oz = ray.o.z() - base_[2];
    const auto along = [&](const EightDoubles(&axis)[3], const auto& vx, const auto& vy, const auto& vz) {
      return EightDoubles(axis[0] * vx + axis[1] * vy + axis[2] * vz);
    };
    const auto at = cylinder_crossings<EightDoubles>(
        along(x_, ox, oy, oz), along(y_, ox, oy, oz), along(z_, ox, oy, oz), along(x_, ray.d.x(), ray.d.y(), ray.d.z()),
        along(y_, ray.d.x(), ray.d.y(), ray.d.z()), along(z_, ray.d.x(), ray.d.y(), ray.d.z()), radius2_);
    const double limit = double(t_max);
    const auto hit0 = at.crosses & (at.t0 > 0) & (at.t0 < limit) & (at.z0 >= 0) & (at.z0 <= height_);
    const auto hit1 = at.crosses & (at.t1 > 0) & (at.t1 < limit) & (at.z1 >= 0) & (at.z1 <= height_);
    return nearest<any>(detail::lane_bits(hit0 | hit1), hit0 ? at.t0 : at.t1, t_max, hit);
  }

 private:
  EightDoubles base_[3], x_[3], y_[3], z_[3], radius2_, height_;
};

} // namespace render
