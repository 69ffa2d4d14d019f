#pragma once
/// Disks as leaves of the BVH.

#include <render/accel/whole_shape_block.h>
#include <render/shape/disk.h>

namespace render {

/// Eight disks, intersected in double. A block type of BlockTree.
class DiskBlock : public WholeShapeBlock<Disk> {
 public:
  /// Stores a disk in a lane.
  void set(std::uint32_t lane, const Primitive& p) {
    const DiskPlane& plane = p.geometry->plane();
    for (int a = 0; a < 3; ++a) {
      center_[a][lane] = p.geometry->center()[a];
      normal_[a][lane] = plane.normal[a];
      x_[a][lane] = plane.x[a];
      y_[a][lane] = plane.y[a];
    }
    set_shape(lane, p.shape);
  }

  /// Nearest hit with 0 < t < t_max, stored in t_max and hit; with any = true, only whether there is a hit.
  template <bool any> bool intersect(const Ray&, const RaySetup& ray, Float& t_max, Hit& hit) const {
    const auto at =
        disk_crossing(normal_, x_, y_, ray.o.x() - center_[0], ray.o.y() - center_[1], ray.o.z() - center_[2], ray.d);
    const double limit = double(t_max);
    return nearest<any>(detail::lane_bits((at.t > 0) & (at.t < limit) & (at.radius2 <= 1)), at.t, t_max, hit);
  }

 private:
  EightDoubles center_[3], normal_[3], x_[3], y_[3]; ///< as in DiskPlane
};

} // namespace render
