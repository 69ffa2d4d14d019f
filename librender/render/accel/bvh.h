#pragma once
/// Ray queries against all shapes of a scene.

#include <render/accel/wide_tree.h>
#include <render/shape/shape.h>

#include <optional>
#include <span>
#include <vector>

namespace render {

struct Shear;
struct Line;

/// Nearest and any hit of single rays.
///   triangles : watertight [WoopBenthinWald13] for inside or outside, re-decided in double on an exact edge; distance
///               from the plane equation in double, since Woop's own is off by up to a percent
///   spheres   : in double
///   Degenerate triangles are left out. Immutable after construction, so threads share it. It copies what it needs: the
///   shapes need not outlive it.
class Bvh {
 public:
  Bvh() = default;
  explicit Bvh(std::span<const Shape* const> shapes);
  explicit Bvh(std::span<const Shape> shapes);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  /// Box of everything; empty for an empty scene.
  const Box& bounds() const { return bounds_; }

 private:
  typedef double EightDoubles __attribute__((vector_size(8 * sizeof(double))));
  /// Eight triangles; spare lanes repeat the last one.
  struct TriangleBlock {
    Lanes v[3][3];                 ///< [vertex][axis]
    EightDoubles normal[3], plane; ///< points p of the plane: normal . p = plane
    std::uint32_t id[8];
  };
  struct TriangleId {
    int shape, prim;
  };
  /// Eight spheres or caps; spare lanes repeat the last one.
  struct SphereBlock {
    EightDoubles center[3], radius2;
    EightDoubles axis[3], cap; ///< a point at `offset` from the centre belongs to the shape where offset . axis >= cap
    int shape[8];
    bool caps; ///< some lane is a cap
  };

  template <bool any>
  bool intersect_block(const TriangleBlock& block, const Ray& ray, const Shear& shear, Float& t_max, Hit& hit) const;
  template <bool any> static bool intersect_block(const SphereBlock& block, const Line& line, Float& t_max, Hit& hit);
  template <bool any> bool trace(const Ray& ray, Hit& hit) const;

  WideTree triangle_tree_, sphere_tree_;       ///< none for few: every ray tries all blocks
  std::vector<TriangleBlock> triangle_blocks_; ///< one per leaf, or all
  std::vector<TriangleId> triangle_ids_;
  std::vector<SphereBlock> sphere_blocks_; ///< one per leaf, or all
  Box bounds_;
};

} // namespace render
