#pragma once
/// What blocks of the BVH share whose primitives are whole shapes.

#include <render/accel/wide_tree.h>
#include <render/core/lanes.h>
#include <render/core/ray.h>
#include <render/shape/concept.h>

#include <cstddef>
#include <cstdint>

namespace render {

/// Base of a block type of BlockTree with eight shapes of type S, one in each lane.
template <class S> class WholeShapeBlock {
 public:
  /// Kind of the shapes.
  using ShapeType = S;
  /// Up to this number of shapes, testing all blocks is faster than a tree.
  static constexpr std::uint32_t max_brute_force = 24;

  /// One shape and its index.
  struct Primitive {
    const S* geometry;
    int shape;

    /// Bounds rounded outward, so that the float box contains the double shape.
    Bounds bounds() const { return Bounds::around(geometry->box()); }
  };
  /// Number of primitives of a shape: 1.
  static std::size_t size(const S&) { return 1; }
  /// Writes the primitive to `to`; returns the end of the output.
  static Primitive* collect(const S& shape, int index, std::size_t, std::size_t, Primitive* to) {
    *to = {&shape, index};
    return to + 1;
  }

  /// The ray in double.
  struct RaySetup {
    Vec3d o, ///< Origin.
        d;   ///< Direction.
    /// Converts the ray.
    explicit RaySetup(const Ray& ray) : o(ray.o.cast<double>()), d(ray.d.cast<double>()) {}
  };

 protected:
  /// Stores the index of the shape of a lane.
  void set_shape(std::uint32_t lane, int shape) { shape_[lane] = shape; }

  /// Stores the nearest of the lanes in `hits` in t_max and hit; with any = true stores nothing. Returns whether there
  /// is a hit.
  template <bool any> bool nearest(unsigned hits, const EightDoubles& t, Float& t_max, Hit& hit) const {
    if (any || hits == 0) return hits != 0;
    int lane = __builtin_ctz(hits);
    while ((hits &= hits - 1) != 0) {
      const int other = __builtin_ctz(hits);
      if (t[other] < t[lane]) lane = other;
    }
    t_max = Float(t[lane]);
    hit = {t[lane], shape_[lane], 0, 0, 0};
    return true;
  }

 private:
  int shape_[8];
};

} // namespace render
