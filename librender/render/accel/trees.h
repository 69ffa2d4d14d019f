#pragma once
/// The trees of a Bvh and its two ray queries, compiled for one instruction set or for several.

#include <render/accel/block_tree.h>
#include <render/accel/bvh.h>
#include <render/accel/cylinder_block.h>
#include <render/accel/disk_block.h>
#include <render/accel/sphere_block.h>
#include <render/accel/triangle_block.h>

#include <concepts>
#include <tuple>

namespace render {

static_assert(alignof(TriangleBlock) == 8 * sizeof(Float) && alignof(SphereBlock) == 8 * sizeof(double) &&
              alignof(DiskBlock) == 8 * sizeof(double) && alignof(CylinderBlock) == 8 * sizeof(double));

/// One tree per block type.
template <class... Block> struct BlockTrees : std::tuple<BlockTree<Block>...> {
  /// Whether the primitives of every kind of shape are in the tree of one block type.
  template <class... Kinds> static constexpr bool cover(const std::variant<Kinds...>*) {
    return (([]<class Kind>(const Kind*) {
              return (std::same_as<Kind, typename Block::ShapeType> + ...);
            }(static_cast<const Kinds*>(nullptr)) == 1) &&
            ...);
  }
  /// Trees without primitives.
  BlockTrees() = default;
  /// Builds one tree per block type.
  explicit BlockTrees(std::span<const Shape* const> shapes)
      : std::tuple<BlockTree<Block>...>(BlockTree<Block>(shapes)...) {}
};

/// The trees of a Bvh, one per block type, in the order in which a ray tests them.
struct Bvh::Trees : BlockTrees<TriangleBlock, SphereBlock, DiskBlock, CylinderBlock> {
  /// Constructors of BlockTrees.
  using BlockTrees::BlockTrees;

  static_assert(cover(static_cast<const Shape*>(nullptr)), "a kind of shape without a block type is never hit");

  /// Nearest hit of the ray, stored in hit; with any = true, only whether there is a hit.
  template <bool any> bool trace(const Ray& ray, Hit& hit) const {
    Float t_max = ray.t_max;
    bool found = false;
    const auto one = [&](const auto& tree) { found |= tree.template intersect<any>(ray, t_max, hit); };
    std::apply([&](const auto&... tree) { ((any && found ? void() : one(tree)), ...); }, kinds());
    return found;
  }
  /// The trees as a tuple.
  const tuple& kinds() const { return *this; }
};

/// The ray queries of trace.cpp, compiled for one instruction set.
struct Bvh::Trace {
  /// Nearest hit, stored in hit; returns whether there is one.
  bool (*nearest)(const Trees& trees, const Ray& ray, Hit& hit);
  /// Whether there is any hit.
  bool (*any)(const Trees& trees, const Ray& ray, Hit& hit);
};

/// Instances of Trace: `native` if the library is built for this machine only, else the three from which the library
/// selects at load time. All give the same bits.
extern const Bvh::Trace trace_native, ///< For the instruction set of this machine.
    trace_baseline,                   ///< For the baseline instruction set.
    trace_avx2,                       ///< For AVX2, FMA, BMI and BMI2.
    trace_avx512;                     ///< For AVX-512.

} // namespace render
