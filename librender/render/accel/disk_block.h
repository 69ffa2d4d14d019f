#pragma once
/// Disks as leaves of the BVH.

#include <render/accel/wide_tree.h>
#include <render/core/lanes.h>
#include <render/core/ray.h>
#include <render/shape/disk.h>

namespace render {

/// Eight disks, intersected in double. A block type of BlockTree.
class DiskBlock {
 public:
  /// Kind of the shapes whose primitives are disks.
  using ShapeType = Disk;
  /// Up to this number of disks, testing all blocks is faster than a tree.
  static constexpr std::uint32_t max_brute_force = 24;

  /// One disk and the index of its shape.
  struct Primitive {
    const Disk* disk;
    int shape;

    /// Bounds rounded outward, so that the float box contains the double disk.
    Bounds bounds() const { return Bounds::around(disk->box()); }
  };
  /// Number of disks in a disk: 1.
  static std::size_t size(const Disk&) { return 1; }
  /// Writes the disk to `to`; returns the end of the output.
  static Primitive* collect(const Disk& disk, int index, std::size_t, std::size_t, Primitive* to) {
    *to = {&disk, index};
    return to + 1;
  }

  /// The ray in double.
  struct RaySetup {
    Vec3d o, ///< Origin.
        d;   ///< Direction.
    /// Converts the ray.
    explicit RaySetup(const Ray& ray) : o(ray.o.cast<double>()), d(ray.d.cast<double>()) {}
  };

  /// Stores a disk in a lane.
  void set(std::uint32_t lane, const Primitive& p) {
    const DiskPlane& plane = p.disk->plane();
    for (int a = 0; a < 3; ++a) {
      center_[a][lane] = p.disk->center()[a];
      normal_[a][lane] = plane.normal[a];
      x_[a][lane] = plane.x[a];
      y_[a][lane] = plane.y[a];
    }
    shape_[lane] = p.shape;
  }

  /// Nearest hit with 0 < t < t_max, stored in t_max and hit; with any = true, only whether there is a hit.
  template <bool any> bool intersect(const Ray&, const RaySetup& ray, Float& t_max, Hit& hit) const {
    const auto at =
        disk_crossing(normal_, x_, y_, ray.o.x() - center_[0], ray.o.y() - center_[1], ray.o.z() - center_[2], ray.d);
    const double limit = double(t_max);
    unsigned hits = detail::lane_bits((at.t > 0) & (at.t < limit) & (at.radius2 <= 1));
    if (any || hits == 0) return hits != 0;
    int lane = __builtin_ctz(hits);
    while ((hits &= hits - 1) != 0) {
      const int other = __builtin_ctz(hits);
      if (at.t[other] < at.t[lane]) lane = other;
    }
    t_max = Float(at.t[lane]);
    hit = {at.t[lane], shape_[lane], 0, 0, 0};
    return true;
  }

 private:
  EightDoubles center_[3], normal_[3], x_[3], y_[3]; ///< as in DiskPlane
  int shape_[8];
};

} // namespace render
